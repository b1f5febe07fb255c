#include "inslab/models/imu/mount_motion.hpp"

#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/motion_course.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::imu {
namespace {

/// The IMU's mount at one instant.
struct Mount {
  Matrix3 C_bm;
  Vector3 omega_mb_b;  ///< rad/s
  Vector3 omega_mb_b_less_turn_rate;
  Vector3 displacement_m;
  Vector3 velocity_m_per_s;
  Vector3 turn_rad;

  explicit Mount(const MountState& state)
      : displacement_m(state.displacement_m), velocity_m_per_s(state.velocity_m_per_s), turn_rad(state.turn_rad) {
    // sin t/t, (1 - cos t)/t^2 and (t - sin t)/t^3 of at most 2 deg: the first terms left out are t^6/5040, t^6/40320
    // and t^6/362880, below 4e-13.
    const double t2 = turn_rad.squaredNorm();
    const double a = 1.0 - t2 / 6.0 + t2 * t2 / 120.0;
    const double b = 0.5 - t2 / 24.0 + t2 * t2 / 720.0;
    const double c = 1.0 / 6.0 - t2 / 120.0 + t2 * t2 / 5040.0;
    Matrix3 cross;
    cross << 0.0, -turn_rad.z(), turn_rad.y(), turn_rad.z(), 0.0, -turn_rad.x(), -turn_rad.y(), turn_rad.x(), 0.0;
    C_bm = Matrix3::Identity() - a * cross + b * cross * cross;
    const Vector3 once = turn_rad.cross(state.turn_rate_rad_per_s);
    omega_mb_b_less_turn_rate = c * turn_rad.cross(once) - b * once;
    omega_mb_b = state.turn_rate_rad_per_s + omega_mb_b_less_turn_rate;
  }

  /// C_bm A of the header.
  Vector3 velocity_b(const Vector3& omega_im_m, const Vector3& arm_m) const {
    return C_bm * (omega_im_m.cross(arm_m + displacement_m) + velocity_m_per_s);
  }
};

/// Gauss's points and weights on -1 to 1, 4 points.
constexpr double kPoints[] = {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                              0.86113631159405257522};
constexpr double kWeights[] = {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                               0.34785484513745385737};

}  // namespace

Increments mounted_increments(const Installation& installation, const TruthState& before, const TruthState& truth,
                              const Installation::Instant& start, const Installation::Instant& end,
                              const Vibration& vibration) {
  const Matrix3& C_mv = installation.C_bv();
  const Vector3 arm_m = C_mv * installation.lever_arm_v_m();
  const double dt_s = time::to_seconds(truth.interval_ns);
  const std::int64_t from_ns = truth.header.sim_time_ns - truth.interval_ns;
  const Course omega_v = Course::through(start.omega_iv_v, end.omega_iv_v, truth.dtheta_v / dt_s, truth.rate_jump);
  Course f_v = Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s, false);
  if (truth.rate_jump || jumps(f_v)) f_v = Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s, true);
  const Course g_v = Course::through(start.gravitation_difference_v, end.gravitation_difference_v,
                                     0.5 * (start.gravitation_difference_v + end.gravitation_difference_v), false);

  Increments sum;
  const double panels = std::max(1.0, std::ceil(4.0 * vibration.fastest_motion_hz() * dt_s));
  for (double panel = 0.0; panel < panels; panel += 1.0) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double part = (panel + 0.5 + 0.5 * kPoints[i]) / panels;
      const double x = 2.0 * part - 1.0;
      const Mount mount(vibration.mount(from_ns, part * dt_s));
      const double weight_s = 0.5 * kWeights[i] * dt_s / panels;
      const Vector3 omega_im_m = C_mv * omega_v.at(x);
      const Vector3 omega_im_b = mount.C_bm * omega_im_m;
      sum.dtheta += weight_s * (omega_im_b + mount.omega_mb_b_less_turn_rate);
      sum.dv += weight_s * (mount.C_bm * (C_mv * (f_v.at(x) + g_v.at(x))) +
                            (omega_im_b + mount.omega_mb_b).cross(mount.velocity_b(omega_im_m, arm_m)));
    }
  }
  const Mount at_start(vibration.mount(from_ns, 0.0));
  const Mount at_end(vibration.mount(truth.header.sim_time_ns, 0.0));
  sum.dtheta += at_end.turn_rad - at_start.turn_rad;
  sum.dv += at_end.velocity_b(C_mv * end.omega_iv_v, arm_m) - at_start.velocity_b(C_mv * start.omega_iv_v, arm_m);
  return sum;
}

MountedPose mounted_pose(const Installation& installation, const TruthState& truth, const Vibration& vibration) {
  const MountState mount = vibration.mount(truth.header.sim_time_ns, 0.0);
  const Matrix3 C_vm = installation.C_bv().transpose();
  MountedPose pose;
  pose.site = sensor_site(truth, installation.lever_arm_v_m() + C_vm * mount.displacement_m);
  pose.site.v_n += pose.site.C_sn * (truth.q_nv * (C_vm * mount.velocity_m_per_s));
  pose.q_nb = nav::canonical(Quaternion(pose.site.C_sn) * truth.q_nv * installation.q_vb() *
                             nav::quaternion_from_rotation_vector(mount.turn_rad));
  return pose;
}

}  // namespace inslab::imu
