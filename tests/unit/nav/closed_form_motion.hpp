#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/strapdown.hpp"

/// Motions whose state is known in closed form: up and down over one point, turning in any way.
namespace inslab::nav {

struct ClosedFormMotion {
  Geodetic place{30.53 * 3.14159265358979323846 / 180.0, 2.0, 20.0};  ///< at t = 0
  Gravity gravity;
  std::function<double(double)> descent_m = [](double) { return 0.0; };        ///< 0 at t = 0
  std::function<double(double)> descent_m_per_s = [](double) { return 0.0; };  ///< its derivatives
  std::function<double(double)> descent_m_per_s2 = [](double) { return 0.0; };
  std::function<Quaternion(double)> q_nb = [](double) { return Quaternion::Identity(); };
  std::function<Vector3(double)> omega_nb_b = [](double) { return Vector3(Vector3::Zero()); };

  NavState state(double t_s) const {
    return {{place.latitude_rad, place.longitude_rad, place.height_m - descent_m(t_s)},
            {0.0, 0.0, descent_m_per_s(t_s)},
            canonical(q_nb(t_s))};
  }

  Vector3 omega_ib_b(double t_s) const {
    return omega_nb_b(t_s) + q_nb(t_s).conjugate() * omega_ie_n(place.latitude_rad);
  }

  /// f = v' + 2 omega_ie x v - g: without horizontal velocity n does not turn against e.
  Vector3 f_b(double t_s) const {
    const NavState now = state(t_s);
    const Vector3 f_n = Vector3(0.0, 0.0, descent_m_per_s2(t_s)) + 2.0 * omega_ie_n(place.latitude_rad).cross(now.v_n) -
                        gravity.g_n(now.position);
    return q_nb(t_s).conjugate() * f_n;
  }

  /// Increments over (from_s, to_s] by Gauss-Legendre with 5 points on each half: of order 10, rounding remains.
  ImuIncrements increments(double from_s, double to_s) const {
    static constexpr std::array<double, 5> node{0.0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                                0.9061798459386640};
    static constexpr std::array<double, 5> weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                                  0.2369268850561891, 0.2369268850561891};
    ImuIncrements sum;
    sum.dt_s = to_s - from_s;
    for (int half = 0; half < 2; ++half) {
      const double middle_s = from_s + (0.25 + 0.5 * half) * sum.dt_s;
      for (std::size_t i = 0; i < node.size(); ++i) {
        const double t_s = middle_s + 0.25 * sum.dt_s * node[i];
        sum.dtheta_b += 0.25 * sum.dt_s * weight[i] * omega_ib_b(t_s);
        sum.dv_b += 0.25 * sum.dt_s * weight[i] * f_b(t_s);
      }
    }
    return sum;
  }
};

/// The body's z axis goes round a cone of half angle `phi_rad` once in `period_s`; the classical test of (2-53).
inline ClosedFormMotion coning_motion(double phi_rad, double period_s) {
  const double Omega = 2.0 * 3.14159265358979323846 / period_s;
  const double s = std::sin(0.5 * phi_rad), c = std::cos(0.5 * phi_rad);
  ClosedFormMotion motion;
  motion.q_nb = [=](double t_s) { return Quaternion(c, s * std::cos(Omega * t_s), s * std::sin(Omega * t_s), 0.0); };
  motion.omega_nb_b = [=](double t_s) {
    return Vector3(-Omega * std::sin(phi_rad) * std::sin(Omega * t_s),
                   Omega * std::sin(phi_rad) * std::cos(Omega * t_s), -2.0 * Omega * s * s);
  };
  return motion;
}

/// Roll and vertical acceleration swing together: their product has a mean that the sculling term has to cancel.
inline ClosedFormMotion sculling_motion(double roll_rad, double acceleration_m_per_s2, double period_s) {
  const double Omega = 2.0 * 3.14159265358979323846 / period_s;
  ClosedFormMotion motion;
  motion.descent_m = [=](double t_s) {
    return acceleration_m_per_s2 / (Omega * Omega) * (Omega * t_s - std::sin(Omega * t_s));
  };
  motion.descent_m_per_s = [=](double t_s) { return acceleration_m_per_s2 / Omega * (1.0 - std::cos(Omega * t_s)); };
  motion.descent_m_per_s2 = [=](double t_s) { return acceleration_m_per_s2 * std::sin(Omega * t_s); };
  motion.q_nb = [=](double t_s) {
    return quaternion_from_rotation_vector({roll_rad * std::sin(Omega * t_s), 0.0, 0.0});
  };
  motion.omega_nb_b = [=](double t_s) { return Vector3(roll_rad * Omega * std::cos(Omega * t_s), 0.0, 0.0); };
  return motion;
}

}  // namespace inslab::nav
