#pragma once

#include <optional>

#include "inslab/referee/score/scorer.hpp"

namespace inslab::score {

/// The solution with the largest horizontal error, and how the vehicle moved then.
struct Moment {
  double time_s = 0.0;  ///< sim time of validity
  double horizontal_m = 0.0;
  double vertical_m = 0.0;           ///< magnitude
  double horizontal_sigma_m = 0.0;   ///< north and east together, as the app reports; 0: it reports none
  double speed_m_per_s = 0.0;        ///< of the true reference point, horizontal
  double turn_rate_deg_per_s = 0.0;  ///< of the true nose, right positive, since the solution before
};

/// Finds the worst moment among scored solutions, told in order of validity.
class WorstMoment {
 public:
  void add(const ScoredSolution& scored);
  /// Nothing when no solution was scored.
  const std::optional<Moment>& found() const { return worst_; }

 private:
  std::optional<Moment> worst_;
  double last_time_s_ = 0.0;
  std::optional<double> last_yaw_rad_;
};

}  // namespace inslab::score
