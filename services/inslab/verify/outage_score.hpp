#pragma once

#include <vector>

#include "nav/strapdown.hpp"

namespace inslab::verify {

/// The largest errors of the solution in one GNSS outage.
struct OutageDrift {
  double horizontal_m = 0.0;
  double vertical_m = 0.0;
  nav::Vector3 attitude_rad = nav::Vector3::Zero();  ///< roll, pitch, yaw
};

/// GNSS outages that come again and again.
struct OutagePlan {
  double first_s = 0.0;  ///< sim time
  double length_s = 60.0;
  double spacing_s = 180.0;
  double run_s = 0.0;  ///< an outage that does not end within the run does not count
};

/// Scores solutions against the truth outage by outage.
class OutageScore {
 public:
  explicit OutageScore(const OutagePlan& plan) : plan_(plan) {}

  void add(std::int64_t sim_time_ns, const nav::NavState& estimate, const nav::NavState& truth);

  const std::vector<OutageDrift>& outages() const { return outages_; }

 private:
  OutagePlan plan_;
  std::vector<OutageDrift> outages_;
};

}  // namespace inslab::verify
