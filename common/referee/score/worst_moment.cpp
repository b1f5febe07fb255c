#include "inslab/referee/score/worst_moment.hpp"

#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::score {

void WorstMoment::add(const ScoredSolution& scored) {
  const double time_s = time::to_seconds(scored.sim_time_ns);
  const double yaw_rad = nav::rpy_from_quaternion(scored.truth.q_n_body).yaw_rad;
  const double elapsed_s = time_s - last_time_s_;
  double turn_rate_deg_per_s = 0.0;
  if (last_yaw_rad_ && elapsed_s > 0.0) {
    turn_rate_deg_per_s = std::remainder(yaw_rad - *last_yaw_rad_, 2.0 * units::kPi) * units::kDegPerRad / elapsed_s;
  }
  last_time_s_ = time_s;
  last_yaw_rad_ = yaw_rad;
  const double horizontal_m = scored.error.position_ned_m.head<2>().norm();
  if (worst_ && horizontal_m <= worst_->horizontal_m) return;
  const double sigma_m = scored.solution.position_sigma_ned_m.head<2>().norm();
  worst_ = Moment{time_s,
                  horizontal_m,
                  std::abs(scored.error.position_ned_m.z()),
                  std::isfinite(sigma_m) ? sigma_m : 0.0,
                  scored.truth.v_n.head<2>().norm(),
                  turn_rate_deg_per_s};
}

}  // namespace inslab::score
