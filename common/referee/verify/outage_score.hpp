#pragma once

#include <vector>

#include "inslab/nav/strapdown.hpp"

namespace inslab::verify {

/// The largest errors of the solution in one GNSS outage.
struct OutageDrift {
  double horizontal_m = 0.0;
  double vertical_m = 0.0;
  nav::Vector3 attitude_rad = nav::Vector3::Zero();  ///< roll, pitch, yaw
};

/// GNSS outages that come again and again; the thesis's, unless said otherwise.
struct OutageTimes {
  double first_s = 420.0;  ///< sim time; beyond the run's end: none
  double length_s = 60.0;
  double spacing_s = 180.0;  ///< from begin to begin

  friend bool operator==(const OutageTimes& a, const OutageTimes& b) {
    return a.first_s == b.first_s && a.length_s == b.length_s && a.spacing_s == b.spacing_s;
  }
};

/// Scores solutions against the truth outage by outage.
class OutageScore {
 public:
  /// An outage that does not end within the run does not count.
  OutageScore(const OutageTimes& times, double run_s) : times_(times), run_s_(run_s) {}

  void add(std::int64_t sim_time_ns, const nav::NavState& estimate, const nav::NavState& truth);

  const std::vector<OutageDrift>& outages() const { return outages_; }

 private:
  OutageTimes times_;
  double run_s_;
  std::vector<OutageDrift> outages_;
};

}  // namespace inslab::verify
