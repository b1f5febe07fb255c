#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/models/imu/increments.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::imu {

/// Stage 1: the perfect IMU at its place, from the truth at the vehicle's reference point.
///
///   f_imu_v = f_v + alpha x l + omega x (omega x l) + C_vn (G(r_v) - G(r_imu)),   omega = omega_iv_v, alpha = omega'
///   dtheta_b = C_bv dtheta_v,   dv_b = C_bv * integral of f_imu_v
///
/// The integral of alpha x l is (omega(t) - omega(t-dt)) x l exactly; at a jump of the rate its impulse lies in the
/// interval that ends there. omega inside the interval is the quadratic with both end values and the exact integral
/// dtheta_v, which leaves |omega'| |omega'''| |l| dt^4 / 360 m/s^2 of centripetal acceleration out; the gravitation
/// difference is the mean of both ends, which leaves |omega|^2 dt^2 / 12 of it out (3e-6 m/s^2 per metre of arm).
class Installation {
 public:
  /// What the next interval needs to know of an instant.
  struct Instant {
    Vector3 omega_iv_v = Vector3::Zero();                ///< rad/s
    Vector3 gravitation_difference_v = Vector3::Zero();  ///< m/s^2, G at the vehicle less G at the IMU
    SensorSite site;
  };

  /// Lever arm in m and mounting angles in deg of `profile`: C_vb = Rz(yaw) Ry(pitch) Rx(roll).
  Installation(const InstallationProfile& profile, const nav::Gravity& gravity);

  Instant at(const TruthState& truth) const;

  /// The perfect increments of the interval that ends at `truth`, in b; `start` and `end` under this installation.
  Increments increments(const TruthState& truth, const Instant& start, const Instant& end) const;

  /// Attitude of b in the IMU's own NED, w >= 0.
  Quaternion q_nb(const TruthState& truth, const Instant& at_truth) const;

  const Vector3& lever_arm_v_m() const { return lever_arm_v_m_; }
  const Quaternion& q_vb() const { return q_vb_; }
  const Matrix3& C_bv() const { return C_bv_; }

 private:
  nav::Gravity gravity_;
  Vector3 lever_arm_v_m_;
  Quaternion q_vb_;
  Matrix3 C_bv_;
  bool has_arm_;
};

}  // namespace inslab::imu
