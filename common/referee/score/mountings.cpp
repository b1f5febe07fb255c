#include "inslab/referee/score/mountings.hpp"

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::score {

void Mountings::add(const InstallationProfile& installation, std::int64_t apply_at_ns) {
  const SensorAddress& target = installation.target;
  const bool of_the_imu = target.kind == SensorKind::Imu && imu_number_ == target.number;
  const bool of_the_antenna = target.kind == SensorKind::Gnss && gnss_number_ == target.number;
  if (!of_the_imu && !of_the_antenna) return;
  const Vector3 rpy_rad = units::kDeg * installation.mounting_rpy_deg;
  const Quaternion q_vb = of_the_imu ? nav::quaternion_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()})
                                     : Quaternion(Quaternion::Identity());
  (of_the_imu ? imu_ : antenna_).push_back({apply_at_ns, {installation.lever_arm_v_m, q_vb}});
}

Mounting Mountings::at(ReferencePoint point, std::int64_t sim_time_ns) const {
  if (point == ReferencePoint::Vehicle) return {};
  const MovedTo* latest = nullptr;
  for (const MovedTo& candidate : point == ReferencePoint::Imu ? imu_ : antenna_) {
    if (candidate.apply_at_ns >= sim_time_ns && candidate.apply_at_ns >= 0) continue;
    if (latest == nullptr || candidate.apply_at_ns >= latest->apply_at_ns) latest = &candidate;
  }
  return latest == nullptr ? Mounting{} : latest->mounting;
}

}  // namespace inslab::score
