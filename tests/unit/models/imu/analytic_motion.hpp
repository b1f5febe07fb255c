#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/wgs84.hpp"

/// A vehicle whose motion in ECEF is written down, so that the truth at any of its points is known without an
/// integration of ours: the reference for lever arms.
namespace inslab::test {

/// Sums f over [a, b] by Gauss-Legendre quadrature with 5 nodes on each of `pieces` equal pieces.
inline Vector3 integral(const std::function<Vector3(double)>& f, double a, double b, int pieces = 4) {
  static constexpr std::array<double, 3> kNode{0.0, 0.53846931010568309104, 0.90617984593866399280};
  static constexpr std::array<double, 3> kWeight{0.56888888888888888889, 0.47862867049936646804,
                                                 0.23692688505618908751};
  Vector3 sum = Vector3::Zero();
  const double half = 0.5 * (b - a) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double middle = a + half * (2 * i + 1);
    sum += kWeight[0] * f(middle);
    for (int k = 1; k < 3; ++k) sum += kWeight[k] * (f(middle - half * kNode[k]) + f(middle + half * kNode[k]));
  }
  return half * sum;
}

/// The attitude is C_ev = C_e(start) Rz(yaw) Ry(pitch) Rx(roll) of sines of time; the reference point goes on a closed
/// curve of some hundred metres round the start. Rate, velocity and acceleration are their exact derivatives.
class AnalyticMotion {
 public:
  explicit AnalyticMotion(double swing = 1.0) : swing_(swing) {
    const nav::Geodetic start{0.53, 1.996, 20.0};
    C_e_ = nav::C_en(start.latitude_rad, start.longitude_rad);
    r0_e_ = nav::ecef_from_geodetic(start);
  }

  Matrix3 C_ev(double t) const { return C_e_ * nav::matrix_from_rpy({angle(t, 0)[0], angle(t, 1)[0], angle(t, 2)[0]}); }
  /// omega_ev in v from the Z-Y-X angles and their rates.
  Vector3 omega_ev_v(double t) const {
    const auto roll = angle(t, 0), pitch = angle(t, 1), yaw = angle(t, 2);
    return {roll[1] - yaw[1] * std::sin(pitch[0]),
            pitch[1] * std::cos(roll[0]) + yaw[1] * std::sin(roll[0]) * std::cos(pitch[0]),
            -pitch[1] * std::sin(roll[0]) + yaw[1] * std::cos(roll[0]) * std::cos(pitch[0])};
  }
  Vector3 omega_iv_v(double t) const { return omega_ev_v(t) + C_ev(t).transpose() * kOmega_e; }

  /// Position, velocity and acceleration relative to e, in e.
  std::array<Vector3, 3> path(double t) const {
    static const std::array<double, 3> amplitude{120.0, 80.0, 10.0}, rate{0.21, 0.33, 0.41};
    std::array<Vector3, 3> n;
    for (int i = 0; i < 3; ++i) {
      n[0][i] = amplitude[i] * std::sin(rate[i] * t);
      n[1][i] = amplitude[i] * rate[i] * std::cos(rate[i] * t);
      n[2][i] = -amplitude[i] * rate[i] * rate[i] * std::sin(rate[i] * t);
    }
    return {r0_e_ + C_e_ * n[0], C_e_ * n[1], C_e_ * n[2]};
  }

  /// Specific force, in v, of a point at `arm_v` whose motion relative to v is rest. `omega_dot` is differentiated
  /// numerically with five points: error h^4/30 of the fifth derivative, below 1e-9 rad/s^2 at h = 1 ms.
  Vector3 f_v(double t, const Vector3& arm_v, const nav::Gravity& gravity) const {
    constexpr double h = 1e-3;
    const Vector3 omega = omega_iv_v(t);
    const Vector3 omega_dot =
        (8.0 * (omega_iv_v(t + h) - omega_iv_v(t - h)) - (omega_iv_v(t + 2 * h) - omega_iv_v(t - 2 * h))) / (12.0 * h);
    const auto [r_e, v_e, a_e] = path(t);
    const Vector3 inertial_e = a_e + 2.0 * kOmega_e.cross(v_e) + kOmega_e.cross(kOmega_e.cross(r_e));
    const Vector3 there_e = r_e + C_ev(t) * arm_v;
    return C_ev(t).transpose() * (inertial_e - gravity.gravitation_e(nav::geodetic_from_ecef(there_e))) +
           omega_dot.cross(arm_v) + omega.cross(omega.cross(arm_v));
  }

  /// What the trajectory server says of the vehicle at sample `k`.
  TruthState truth(std::int64_t k, std::int64_t period_ns, const nav::Gravity& gravity) const {
    const double t = time::to_seconds(k * period_ns);
    const double t_before = time::to_seconds((k - 1) * period_ns);
    const auto [r_e, v_e, a_e] = path(t);
    TruthState truth;
    truth.header.sequence_number = static_cast<std::uint64_t>(k);
    truth.header.sim_time_ns = k * period_ns;
    const nav::Geodetic position = nav::geodetic_from_ecef(r_e);
    truth.latitude_rad = position.latitude_rad;
    truth.longitude_rad = position.longitude_rad;
    truth.height_m = position.height_m;
    const Matrix3 C_ne = nav::C_en(position.latitude_rad, position.longitude_rad).transpose();
    truth.v_n = C_ne * v_e;
    truth.q_nv = nav::quaternion_from_matrix(C_ne * C_ev(t));
    truth.omega_iv_v = omega_iv_v(t);
    truth.f_v = f_v(t, Vector3::Zero(), gravity);
    if (k == 0) return truth;
    truth.interval_ns = period_ns;
    truth.dtheta_v = integral([this](double s) { return omega_iv_v(s); }, t_before, t);
    truth.dv_v = integral([&](double s) { return f_v(s, Vector3::Zero(), gravity); }, t_before, t);
    return truth;
  }

  static inline const Vector3 kOmega_e{0.0, 0.0, nav::wgs84::omega_e_rad_per_s};

 private:
  /// Angle and rate of axis `i`.
  std::array<double, 2> angle(double t, int i) const {
    static const std::array<double, 3> amplitude{0.4, 0.3, 1.5}, rate{0.9, 1.3, 0.35}, phase{0.1, 0.7, 2.0};
    const double a = swing_ * amplitude[i];
    return {a * std::sin(rate[i] * t + phase[i]), a * rate[i] * std::cos(rate[i] * t + phase[i])};
  }

  double swing_;
  Matrix3 C_e_;
  Vector3 r0_e_;
};

}  // namespace inslab::test
