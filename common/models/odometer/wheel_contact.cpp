#include "inslab/models/odometer/wheel_contact.hpp"

#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::odometer {
namespace {

/// The attitude in the middle of an interval: half of the turn, and by how much the vehicle turns faster in one half.
/// The rate at the end is one after a jump there, which says nothing of the interval.
Quaternion q_nv_in_the_middle(const TruthState& start, const TruthState& end, double dt_s) {
  Quaternion turn = start.q_nv.conjugate() * end.q_nv;
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Vector3 more_rad = end.rate_jump ? Vector3(0.25 * (start.omega_iv_v * dt_s - end.dtheta_v))
                                         : Vector3(0.125 * dt_s * (start.omega_iv_v - end.omega_iv_v));
  const Vector3 half_rad = 0.5 * nav::rotation_vector_from_quaternion(turn) + more_rad;
  return start.q_nv * nav::quaternion_from_rotation_vector(half_rad);
}

}  // namespace

void WheelContact::use(const InstallationProfile& installation) {
  const Vector3 mounting_rad = units::kDeg * installation.mounting_rpy_deg;
  const Matrix3 C_vb = nav::matrix_from_rpy({mounting_rad.x(), mounting_rad.y(), mounting_rad.z()});
  along_v_ = C_vb.col(0);
  across_v_ = C_vb.col(1);
  contact_v_m_ = installation.lever_arm_v_m;
}

Rolled WheelContact::over(const TruthState& start, const TruthState& end) const {
  Rolled rolled;
  rolled.dt_s = time::to_seconds(end.interval_ns);
  if (!(rolled.dt_s > 0.0)) return rolled;
  const Vector3 mean_n = nav::ned_from(geodetic_of(start), geodetic_of(end)) / rolled.dt_s;
  const Vector3 middle_n = 1.5 * mean_n - 0.25 * (start.v_n + end.v_n);
  const Quaternion q_nv = q_nv_in_the_middle(start, end, rolled.dt_s);
  const Vector3 way_v_m = (rolled.dt_s / 6.0) * (start.q_nv.conjugate() * start.v_n +
                                                 4.0 * (q_nv.conjugate() * middle_n) + end.q_nv.conjugate() * end.v_n);
  Vector3 turn_v_rad = end.dtheta_v;
  if (!contact_v_m_.isZero(0.0)) {
    turn_v_rad -= q_nv.conjugate() * (rolled.dt_s * nav::omega_ie_n(start.latitude_rad));
  }
  rolled.along_m = along_v_.dot(way_v_m + turn_v_rad.cross(contact_v_m_));
  rolled.force_along_m_s2 = along_v_.dot(end.dv_v) / rolled.dt_s;
  rolled.force_across_m_s2 = across_v_.dot(end.dv_v) / rolled.dt_s;
  return rolled;
}

}  // namespace inslab::odometer
