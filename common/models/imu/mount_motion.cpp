#include "inslab/models/imu/mount_motion.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
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

MountedInterval::MountedInterval(const Installation& installation, const TruthState& before, const TruthState& truth,
                                 const Installation::Instant& start, const Installation::Instant& end,
                                 const Vibration& vibration)
    : vibration_(vibration),
      from_ns_(truth.header.sim_time_ns - truth.interval_ns),
      to_ns_(truth.header.sim_time_ns),
      dt_s_(time::to_seconds(truth.interval_ns)),
      panels_(std::max(1.0, std::ceil(4.0 * vibration.fastest_motion_hz() * dt_s_))),
      C_mv_(installation.C_bv()),
      arm_m_(C_mv_ * installation.lever_arm_v_m()),
      omega_start_v_(start.omega_iv_v),
      omega_end_v_(end.omega_iv_v),
      omega_v_(Course::through(start.omega_iv_v, end.omega_iv_v, truth.dtheta_v / dt_s_, truth.rate_jump)),
      f_v_(Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s_, false)),
      g_v_(Course::through(start.gravitation_difference_v, end.gravitation_difference_v,
                           0.5 * (start.gravitation_difference_v + end.gravitation_difference_v), false)) {
  if (truth.rate_jump || jumps(f_v_)) f_v_ = Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s_, true);
}

/// Calls `sum(part, weight_s)` at each of Gauss's points between two instants of the interval.
template <class Sum>
void MountedInterval::sum_over(double from, double to, const Sum& sum) const {
  for (double panel = 0.0; panel < panels_; panel += 1.0) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double part = from + (to - from) * ((panel + 0.5 + 0.5 * kPoints[i]) / panels_);
      sum(part, 0.5 * kWeights[i] * dt_s_ / panels_ * (to - from));
    }
  }
}

MountState MountedInterval::mount(double part) const {
  return part == 1.0 ? vibration_.mount(to_ns_, 0.0) : vibration_.mount(from_ns_, part * dt_s_);
}

/// At the ends what the truth says: the rate after a jump.
Vector3 MountedInterval::omega_im_m(double part) const {
  if (part == 0.0) return C_mv_ * omega_start_v_;
  if (part == 1.0) return C_mv_ * omega_end_v_;
  return C_mv_ * omega_v_.at(2.0 * part - 1.0);
}

Increments MountedInterval::increments(double from, double to) const {
  Increments sum;
  sum_over(from, to, [&](double part, double weight_s) {
    const double x = 2.0 * part - 1.0;
    const Mount mount(this->mount(part));
    const Vector3 omega_im_m = C_mv_ * omega_v_.at(x);
    const Vector3 omega_im_b = mount.C_bm * omega_im_m;
    sum.dtheta += weight_s * (omega_im_b + mount.omega_mb_b_less_turn_rate);
    sum.dv += weight_s * (mount.C_bm * (C_mv_ * (f_v_.at(x) + g_v_.at(x))) +
                          (omega_im_b + mount.omega_mb_b).cross(mount.velocity_b(omega_im_m, arm_m_)));
  });
  const Mount at_start(mount(from)), at_end(mount(to));
  sum.dtheta += at_end.turn_rad - at_start.turn_rad;
  sum.dv += at_end.velocity_b(omega_im_m(to), arm_m_) - at_start.velocity_b(omega_im_m(from), arm_m_);
  return sum;
}

Vector3 MountedInterval::size_effect(const SizeEffect& size_effect, double from, double to) const {
  const auto omega_ib_b = [&](const Vector3& omega_im_m, double part) {
    const Mount mount(this->mount(part));
    return Vector3(mount.C_bm * omega_im_m + mount.omega_mb_b);
  };
  Vector3 sum = size_effect.of_alpha(omega_ib_b(omega_im_m(to), to) - omega_ib_b(omega_im_m(from), from));
  sum_over(from, to, [&](double part, double weight_s) {
    sum += weight_s * size_effect.of_rate(omega_ib_b(C_mv_ * omega_v_.at(2.0 * part - 1.0), part));
  });
  return sum;
}

Increments mounted_increments(const Installation& installation, const TruthState& before, const TruthState& truth,
                              const Installation::Instant& start, const Installation::Instant& end,
                              const Vibration& vibration) {
  return MountedInterval(installation, before, truth, start, end, vibration).increments();
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
