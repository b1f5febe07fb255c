#include "inslab/models/magnetometer/sensed_field.hpp"

#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/magnetometer/magnetic_body.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::magnetometer {

void SensedField::use(const InstallationProfile& installation) {
  const Vector3 mounting_rad = units::kDeg * installation.mounting_rpy_deg;
  C_bv_ = nav::matrix_from_rpy({mounting_rad.x(), mounting_rad.y(), mounting_rad.z()}).transpose();
  lever_arm_v_m_ = installation.lever_arm_v_m;
}

Vector3 SensedField::B_b_nt(const TruthState& truth) {
  if (!earth_) {
    const time::GpsTime now{truth.header.gps_week, truth.header.gps_time_of_week_ns};
    earth_.emplace(time::decimal_year(now + time::Nanoseconds(-truth.header.sim_time_ns)));
  }
  const SensorSite site = sensor_site(truth, lever_arm_v_m_);
  Vector3 B_s = earth_->B_n_nt(site.position);
  for (const MagneticBody& body : bodies_) B_s += field_n_nt(body, site.position);
  return C_bv_ * (truth.q_nv.conjugate() * (site.C_sn.transpose() * B_s));
}

Matrix3 response(const MagnetometerErrorProfile& profile) {
  using RowByRow = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return Matrix3::Identity() + Eigen::Map<const RowByRow>(profile.soft_iron.data());
}

time::Course<Vector3> currents_nt(const MagnetometerErrorProfile& profile) {
  std::vector<time::Course<Vector3>::Corner> corners;
  for (const CurrentField& current : profile.currents) corners.push_back({current.at_s, current.B_b_nt});
  return time::Course<Vector3>(corners, Vector3::Zero());
}

}  // namespace inslab::magnetometer
