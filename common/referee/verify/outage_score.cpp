#include "inslab/referee/verify/outage_score.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::verify {

void OutageScore::add(std::int64_t sim_time_ns, const nav::NavState& estimate, const nav::NavState& truth) {
  const double since_s = time::to_seconds(sim_time_ns) - times_.first_s;
  if (since_s < 0.0) return;
  const auto outage = static_cast<std::size_t>(since_s / times_.spacing_s);
  const double begin_s = static_cast<double>(outage) * times_.spacing_s;
  const bool ends_in_the_run = times_.first_s + begin_s + times_.length_s <= run_s_;
  if (since_s - begin_s >= times_.length_s || !ends_in_the_run) return;
  if (outages_.size() <= outage) outages_.resize(outage + 1);
  OutageDrift& drift = outages_[outage];
  const nav::Vector3 error_m = nav::ned_from(truth.position, estimate.position);
  drift.horizontal_m = std::max(drift.horizontal_m, error_m.head<2>().norm());
  drift.vertical_m = std::max(drift.vertical_m, std::abs(error_m.z()));
  const nav::RollPitchYaw found = nav::rpy_from_quaternion(estimate.q_nb);
  const nav::RollPitchYaw true_rpy = nav::rpy_from_quaternion(truth.q_nb);
  const nav::Vector3 angles(nav::wrapped_to_pi(found.roll_rad - true_rpy.roll_rad),
                            found.pitch_rad - true_rpy.pitch_rad, nav::wrapped_to_pi(found.yaw_rad - true_rpy.yaw_rad));
  drift.attitude_rad = drift.attitude_rad.cwiseMax(angles.cwiseAbs());
}

}  // namespace inslab::verify
