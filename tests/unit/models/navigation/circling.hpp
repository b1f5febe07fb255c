#pragma once

#include <cmath>
#include <optional>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/nav/attitude.hpp"

/// A vehicle on a circle, without errors, and the filter that follows it.
namespace inslab::navigation::circling {

inline constexpr double kDt_s = 0.005;
inline constexpr std::int64_t kDt_ns = 5'000'000;
inline const nav::Gravity kGravity;

/// A vehicle that circles, mechanized: its states are the truth of its own increments.
class Circling {
 public:
  explicit Circling(double speed_m_per_s = 10.0, double rate_rad_per_s = 0.1)
      : speed_(speed_m_per_s),
        rate_(rate_rad_per_s),
        strapdown_({{0.53, 2.0, 50.0}, {speed_m_per_s, 0.0, 0.0}, nav::Quaternion::Identity()}, kGravity, {true}) {}

  nav::NavState state() const { return strapdown_.state(); }
  std::int64_t time_ns() const { return static_cast<std::int64_t>(k_) * kDt_ns; }
  const Vector3& omega_ib_b() const { return omega_ib_b_; }

  /// Of a point that the arm leads to, over the ground, in the vehicle's axes, m/s; the turn is that of the newest
  /// interval.
  Vector3 velocity_b(const Vector3& arm_b_m) const {
    const nav::NavState now = state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    return C_bn * now.v_n + (omega_ib_b_ - C_bn * nav::omega_ie_n(now.position.latitude_rad)).cross(arm_b_m);
  }

  ImuSample next() { return next_with(Vector3(0.0, speed_ * rate_, 0.0)); }

  /// Leaves the circle: its velocity in its own axes changes by `push_b`, m/s^2, whatever that velocity is.
  ImuSample next(const Vector3& push_b) {
    const nav::NavState now = strapdown_.state();
    const Vector3 v_b = nav::matrix_from_quaternion(now.q_nb).transpose() * now.v_n;
    return next_with(push_b + Vector3(0.0, 0.0, rate_).cross(v_b));
  }

  GnssFix fix(const Vector3& arm_b_m = Vector3::Zero()) const {
    const nav::NavState now = state();
    const Matrix3 C_nb = nav::matrix_from_quaternion(now.q_nb);
    const nav::Geodetic antenna = nav::displaced(now.position, C_nb * arm_b_m);
    GnssFix fix;
    fix.header.sim_time_ns = time_ns();
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = antenna.latitude_rad;
    fix.longitude_rad = antenna.longitude_rad;
    fix.height_m = antenna.height_m;
    fix.v_n =
        now.v_n + C_nb * omega_ib_b_.cross(arm_b_m) - nav::omega_ie_n(now.position.latitude_rad).cross(C_nb * arm_b_m);
    fix.position_sigma_ned_m = Vector3::Constant(0.02);
    fix.velocity_sigma_ned_m_per_s = Vector3::Constant(0.03);
    return fix;
  }

 private:
  /// The interval in which the velocity changes by `force_b` in axes that do not turn.
  ImuSample next_with(const Vector3& force_b) {
    const nav::NavState now = strapdown_.state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    const Vector3 omega_ie = nav::omega_ie_n(now.position.latitude_rad);
    const Vector3 omega_en = nav::omega_en_n(now.position, now.v_n);
    omega_ib_b_ = C_bn * (omega_ie + omega_en) + Vector3(0.0, 0.0, rate_);
    const Vector3 f_b = force_b + C_bn * ((2.0 * omega_ie + omega_en).cross(now.v_n) - kGravity.g_n(now.position));
    ImuSample sample;
    sample.dtheta_b = kDt_s * omega_ib_b_;
    sample.dv_b = kDt_s * f_b;
    sample.interval_ns = kDt_ns;
    sample.header.sequence_number = k_++;
    sample.header.sim_time_ns = time_ns();
    strapdown_.advance({sample.dtheta_b, sample.dv_b, kDt_s});
    return sample;
  }

  double speed_;
  double rate_;
  nav::Strapdown strapdown_;
  std::uint64_t k_ = 0;
  Vector3 omega_ib_b_ = Vector3::Zero();
};

inline double error_m(const NavSolution& solution, const Circling& truth) {
  return nav::ned_from(truth.state().position, geodetic_of(solution)).norm();
}

inline NavigationFilter begun(const Circling& truth, const NavigationParameters& p = {}) {
  NavigationFilter filter(p, kGravity);
  filter.start(truth.state(), truth.time_ns());
  return filter;
}

inline bool is_fix_time(const Circling& truth) { return truth.time_ns() % 200'000'000 == 0; }

/// Runs for `seconds` with fixes at 5 Hz, each shifted by `shift_m` to the north.
inline NavSolution run(NavigationFilter& filter, Circling& truth, double seconds, double shift_m) {
  std::optional<NavSolution> solution;
  for (int k = 0; k < static_cast<int>(std::lround(seconds / kDt_s)); ++k) {
    solution = filter.add(truth.next());
    if (!is_fix_time(truth)) continue;
    GnssFix fix = truth.fix();
    const nav::Geodetic shifted = nav::displaced(geodetic_of(fix), {shift_m, 0.0, 0.0});
    fix.latitude_rad = shifted.latitude_rad;
    fix.longitude_rad = shifted.longitude_rad;
    filter.add(fix);
  }
  return *solution;
}

}  // namespace inslab::navigation::circling
