#pragma once

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/imu/installation.hpp"
#include "inslab/models/imu/motion_course.hpp"
#include "inslab/models/imu/size_effect.hpp"
#include "inslab/models/imu/vibration.hpp"

/// Stage 2 in the domain `motion`: the perfect IMU on a mount that moves against the vehicle.
namespace inslab::imu {

/// The perfect increments of the interval from `before` to `truth` in the moving axes b; `start` and `end` are the
/// installation at both, as for Installation::increments.
///
/// With the mount's axes at rest m, displacement d, rotation vector phi (C_mb = exp(phi)), l the arm at rest and
///
///   A = omega_im_m x (l + d) + d'                           (velocity against the vehicle's point, inertial, in m)
///   omega_ib_b = C_bm omega_im_m + J_r(phi) phi'            (J_r: right Jacobian of the rotation group)
///   dtheta_b = [phi] + integral of C_bm omega_im_m + (J_r(phi) - 1) phi'
///   dv_b     = [C_bm A] + integral of C_bm (f_m + G(r_v) - G(r_imu)) + omega_ib_b x (C_bm A)
///
/// where [..] is the difference of both ends and f_m the force at the vehicle's point: the accelerations are integrated
/// by parts, so that no second derivative is needed and the ends meet those of the neighbouring intervals, jumps of the
/// rate included. The integrals are Gauss sums of 4 points over at most a quarter of the fastest period, which leave
/// 1e-8 of their oscillating parts. omega and f are the quadratics with both end values and the interval's exact
/// integral (straight lines through the first value where they jump at the end); the gravitation difference is that of
/// the arm at rest: of 5 cm it leaves 2e-7 m/s^2 out, of mean 0.
Increments mounted_increments(const Installation& installation, const TruthState& before, const TruthState& truth,
                              const Installation::Instant& start, const Installation::Instant& end,
                              const Vibration& vibration);

/// The same interval part by part.
class MountedInterval {
 public:
  /// What is given must outlive it.
  MountedInterval(const Installation& installation, const TruthState& before, const TruthState& truth,
                  const Installation::Instant& start, const Installation::Instant& end, const Vibration& vibration);

  /// Over the part of the interval between two instants of it, 0 to 1.
  Increments increments(double from = 0.0, double to = 1.0) const;
  /// What the accelerometers feel there more at their own places, m/s.
  Vector3 size_effect(const SizeEffect& size_effect, double from = 0.0, double to = 1.0) const;

 private:
  template <class Sum>
  void sum_over(double from, double to, const Sum& sum) const;
  Vector3 omega_im_m(double part) const;
  MountState mount(double part) const;

  const Vibration& vibration_;
  std::int64_t from_ns_, to_ns_;
  double dt_s_;
  double panels_;
  Matrix3 C_mv_;
  Vector3 arm_m_;
  Vector3 omega_start_v_, omega_end_v_;
  Course omega_v_, f_v_, g_v_;
};

/// Place, velocity and attitude of the IMU on its moving mount at `truth`.
struct MountedPose {
  SensorSite site;
  Quaternion q_nb = Quaternion::Identity();  ///< w >= 0, in the IMU's own NED
};
MountedPose mounted_pose(const Installation& installation, const TruthState& truth, const Vibration& vibration);

}  // namespace inslab::imu
