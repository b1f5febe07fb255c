#include "inslab/referee/score/mountings.hpp"

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::score {

void Mountings::add(const InstallationProfile& installation, std::int64_t apply_at_ns) {
  const bool is_imu = installation.target.kind == SensorKind::Imu;
  if ((is_imu ? imu_number_ : gnss_number_) != installation.target.number) return;
  const Vector3 rpy_rad = units::kDeg * installation.mounting_rpy_deg;
  const Quaternion q_vb =
      is_imu ? nav::quaternion_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()}) : Quaternion(Quaternion::Identity());
  (is_imu ? imu_ : antenna_).push_back({apply_at_ns, {installation.lever_arm_v_m, q_vb}});
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
