#include "inslab/models/imu/installation.hpp"

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::imu {
namespace {

/// Integral of omega x (omega x l) over an interval of `dt_s` in which omega is quadratic, from its Legendre series
/// omega = mean + slope P1 + curve P2: the products of different P average to 0, P1^2 to 1/3, P2^2 to 1/5.
Vector3 centripetal_integral(const Vector3& mean, const Vector3& slope, const Vector3& curve, const Vector3& l,
                             double dt_s) {
  return dt_s * (mean.cross(mean.cross(l)) + slope.cross(slope.cross(l)) / 3.0 + curve.cross(curve.cross(l)) / 5.0);
}

}  // namespace

Installation::Installation(const InstallationProfile& profile, const nav::Gravity& gravity)
    : gravity_(gravity),
      lever_arm_v_m_(profile.lever_arm_v_m),
      q_vb_(nav::quaternion_from_rpy({profile.mounting_rpy_deg.x() * units::kDeg,
                                      profile.mounting_rpy_deg.y() * units::kDeg,
                                      profile.mounting_rpy_deg.z() * units::kDeg})),
      C_bv_(q_vb_.toRotationMatrix().transpose()),
      has_arm_(!lever_arm_v_m_.isZero(0.0)) {}

Installation::Instant Installation::at(const TruthState& truth) const {
  Instant instant{truth.omega_iv_v, Vector3::Zero(), sensor_site(truth, lever_arm_v_m_)};
  if (!has_arm_) return instant;
  // In the vehicle's NED: G = g + omega_ie x (omega_ie x r), so the centrifugal parts differ by the arm's own.
  const SensorSite& site = instant.site;
  const Vector3 g_at_vehicle =
      gravity_.g_n(site.sin_vehicle_latitude, truth.height_m, [&truth] { return geodetic_of(truth); });
  const Vector3 g_at_imu = site.C_sn.transpose() *
                           gravity_.g_n(site.sin_latitude, site.position.height_m, [&site] { return site.position; });
  const Vector3 arm_n = truth.q_nv * lever_arm_v_m_;
  const Vector3 difference_n = g_at_vehicle - g_at_imu - site.omega_ie_n.cross(site.omega_ie_n.cross(arm_n));
  instant.gravitation_difference_v = truth.q_nv.conjugate() * difference_n;
  return instant;
}

Increments Installation::increments(const TruthState& truth, const Instant& start, const Instant& end) const {
  if (!has_arm_) return {C_bv_ * truth.dtheta_v, C_bv_ * truth.dv_v};
  const double dt_s = time::to_seconds(truth.interval_ns);
  const Vector3 mean = truth.dtheta_v / dt_s;
  // At a jump the value at the end is the one after it and says nothing of the interval: a straight line is left.
  const Vector3 slope =
      truth.rate_jump ? Vector3(mean - start.omega_iv_v) : Vector3(0.5 * (end.omega_iv_v - start.omega_iv_v));
  const Vector3 curve =
      truth.rate_jump ? Vector3(Vector3::Zero()) : Vector3(0.5 * (start.omega_iv_v + end.omega_iv_v) - mean);
  const Vector3 dv_v = truth.dv_v + (end.omega_iv_v - start.omega_iv_v).cross(lever_arm_v_m_) +
                       centripetal_integral(mean, slope, curve, lever_arm_v_m_, dt_s) +
                       (0.5 * dt_s) * (start.gravitation_difference_v + end.gravitation_difference_v);
  return {C_bv_ * truth.dtheta_v, C_bv_ * dv_v};
}

Quaternion Installation::q_nb(const TruthState& truth, const Instant& at_truth) const {
  const Quaternion q_nb_at_vehicle = truth.q_nv * q_vb_;
  if (!has_arm_) return nav::canonical(q_nb_at_vehicle);
  return nav::canonical(Quaternion(at_truth.site.C_sn) * q_nb_at_vehicle);
}

}  // namespace inslab::imu
