#pragma once

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/imu/installation.hpp"
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

/// Place, velocity and attitude of the IMU on its moving mount at `truth`.
struct MountedPose {
  SensorSite site;
  Quaternion q_nb = Quaternion::Identity();  ///< w >= 0, in the IMU's own NED
};
MountedPose mounted_pose(const Installation& installation, const TruthState& truth, const Vibration& vibration);

}  // namespace inslab::imu
