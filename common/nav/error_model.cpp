#include "inslab/nav/error_model.hpp"

#include <cmath>

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

/// Derivatives of normal gravity by distance north and by distance down, 1/s^2. Central differences: their rounding,
/// 1e-10 of the gradient, is far below what the quadratic in height itself leaves out.
struct GravityGradient {
  double north;
  double down;
};

GravityGradient gravity_gradient(const Gravity& gravity, double s, double c, double height_m, double meridian_m) {
  constexpr double kStepOfSine = 1e-4;
  constexpr double kStepOfHeight_m = 10.0;
  const double by_sine =
      (gravity.normal_m_per_s2(s + kStepOfSine, height_m) - gravity.normal_m_per_s2(s - kStepOfSine, height_m)) /
      (2.0 * kStepOfSine);
  const double by_height = (gravity.normal_m_per_s2(s, height_m + kStepOfHeight_m) -
                            gravity.normal_m_per_s2(s, height_m - kStepOfHeight_m)) /
                           (2.0 * kStepOfHeight_m);
  return {by_sine * c / meridian_m, -by_height};
}

}  // namespace

Matrix9 error_dynamics(const Geodetic& position, const Vector3& v_n, const Vector3& f_n, const Gravity& gravity) {
  using namespace wgs84;
  const double s = std::sin(position.latitude_rad), c = std::cos(position.latitude_rad), t = s / c;
  const double w2 = 1.0 - e2 * s * s;
  const double N = transverse_radius_from_sine_m(s), M = meridian_radius_from_sine_m(s);
  const double n = N + position.height_m, m = M + position.height_m;
  const double N_by_north = N * e2 * s * c / w2 / m, M_by_north = 3.0 * M * e2 * s * c / w2 / m;
  const double v_N = v_n.x(), v_E = v_n.y(), v_D = v_n.z();

  Matrix3 rate_ie_by_r = Matrix3::Zero();
  rate_ie_by_r.col(0) << -omega_e_rad_per_s * s / m, 0.0, -omega_e_rad_per_s * c / m;
  Matrix3 rate_en_by_r = Matrix3::Zero();
  rate_en_by_r.col(0) << -v_E * N_by_north / (n * n), v_N * M_by_north / (m * m),
      -v_E / (n * c * c * m) + v_E * t * N_by_north / (n * n);
  rate_en_by_r.col(2) << v_E / (n * n), -v_N / (m * m), -v_E * t / (n * n);
  Matrix3 rate_en_by_v = Matrix3::Zero();
  rate_en_by_v(0, 1) = 1.0 / n;
  rate_en_by_v(1, 0) = -1.0 / m;
  rate_en_by_v(2, 1) = -t / n;
  const Vector3 omega_ie_n(omega_e_rad_per_s * c, 0.0, -omega_e_rad_per_s * s);
  const Vector3 omega_en_n(v_E / n, -v_N / m, -v_E * t / n);
  const GravityGradient gradient = gravity_gradient(gravity, s, c, position.height_m, m);

  Matrix9 F = Matrix9::Zero();
  F.block<3, 3>(0, 0) << -v_D / m, 0.0, v_N / m, v_E * t / n, -(v_D + v_N * t) / n, v_E / n, 0.0, 0.0, 0.0;
  F.block<3, 3>(0, 3).setIdentity();
  F.block<3, 3>(3, 0) = skew(v_n) * (2.0 * rate_ie_by_r + rate_en_by_r);
  F(5, 0) += gradient.north;
  F(5, 2) += gradient.down;
  F.block<3, 3>(3, 3) = skew(v_n) * rate_en_by_v - skew(2.0 * omega_ie_n + omega_en_n);
  F.block<3, 3>(3, 6) = skew(f_n);
  F.block<3, 3>(6, 0) = rate_ie_by_r + rate_en_by_r;
  F.block<3, 3>(6, 3) = rate_en_by_v;
  F.block<3, 3>(6, 6) = -skew(omega_ie_n + omega_en_n);
  return F;
}

}  // namespace inslab::nav
