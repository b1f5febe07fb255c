#include "inslab/nav/error_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

/// F against finite differences of the mechanization itself.
namespace inslab::nav {
namespace error_model_test {

using Vector9 = Eigen::Matrix<double, 9, 1>;

const Vector3 kRate_b(0.01, -0.02, 0.015);  // rad/s
const Vector3 kForce_b(1.0, -2.0, -9.5);    // m/s^2
const Vector3 kSteps(1000.0, 1.0, 1e-3);    // of position (m), velocity (m/s) and tilt (rad)

NavState flying() {
  return {{40.0 * units::kDeg, 1.0, 3000.0}, {150.0, -120.0, 5.0}, quaternion_from_rpy({0.2, -0.1, 2.0})};
}

/// The state an estimate with this error would hold.
NavState with_error(const NavState& truth, const Vector9& x) {
  NavState state = truth;
  const double lat = truth.position.latitude_rad, h = truth.position.height_m;
  state.position.latitude_rad += x[0] / (wgs84::meridian_radius_m(lat) + h);
  state.position.longitude_rad += x[1] / ((wgs84::transverse_radius_m(lat) + h) * std::cos(lat));
  state.position.height_m -= x[2];
  state.v_n += x.segment<3>(3);
  state.q_nb = quaternion_from_rotation_vector(-x.tail<3>()) * truth.q_nb;
  return state;
}

Vector9 error_of(const NavState& found, const NavState& truth) {
  const double lat = truth.position.latitude_rad, h = truth.position.height_m;
  Vector9 x;
  x[0] = (found.position.latitude_rad - lat) * (wgs84::meridian_radius_m(lat) + h);
  x[1] = (found.position.longitude_rad - truth.position.longitude_rad) * (wgs84::transverse_radius_m(lat) + h) *
         std::cos(lat);
  x[2] = h - found.position.height_m;
  x.segment<3>(3) = found.v_n - truth.v_n;
  x.tail<3>() = -rotation_vector_from_quaternion(found.q_nb * truth.q_nb.conjugate());
  return x;
}

NavState after(const NavState& start, const Gravity& gravity, double dt_s) {
  Strapdown strapdown(start, gravity, {});
  strapdown.advance({kRate_b * dt_s, kForce_b * dt_s, dt_s});
  return strapdown.state();
}

/// (Phi - I)/dt of one interval by central differences.
Matrix9 mean_rate(const Gravity& gravity, double dt_s) {
  const NavState start = flying(), end = after(start, gravity, dt_s);
  Matrix9 Phi;
  for (int i = 0; i < 9; ++i) {
    Vector9 x = Vector9::Zero();
    x[i] = kSteps[i / 3];
    const Vector9 plus = error_of(after(with_error(start, x), gravity, dt_s), end);
    const Vector9 minus = error_of(after(with_error(start, -x), gravity, dt_s), end);
    Phi.col(i) = (plus - minus) / (2.0 * kSteps[i / 3]);
  }
  return (Phi - Matrix9::Identity()) / dt_s;
}

/// The limit of mean_rate() at dt 0: the polynomial through intervals of 2, 1, 1/2 and 1/4 s (Neville).
Matrix9 measured_dynamics(const Gravity& gravity) {
  std::array<Matrix9, 4> column;
  for (std::size_t k = 0; k < column.size(); ++k) column[k] = mean_rate(gravity, 2.0 / static_cast<double>(1U << k));
  for (std::size_t order = 1; order < column.size(); ++order) {
    const double ratio = static_cast<double>(1U << order);
    for (std::size_t k = column.size() - 1; k >= order; --k) {
      column[k] = (ratio * column[k] - column[k - 1]) / (ratio - 1.0);
    }
  }
  return column.back();
}

void expect_blocks_equal(const Matrix9& found, const Matrix9& expected) {
  for (int i = 0; i < 9; i += 3) {
    for (int j = 0; j < 9; j += 3) {
      const double largest = expected.block<3, 3>(i, j).cwiseAbs().maxCoeff();
      // A block of zeros: latitude is rounded to 7e-10 m, over 1e-3 rad and a quarter of a second, times the
      // extrapolation's weights.
      const double tolerance = largest > 0.0 ? 1e-6 * largest : 2e-5;
      const Matrix3 off = (found - expected).block<3, 3>(i, j);
      EXPECT_LT(off.cwiseAbs().maxCoeff(), tolerance) << "block " << i << ", " << j;
    }
  }
}

TEST(ErrorDynamics, AreTheDerivativesOfTheMechanization) {
  for (const GravityModel model : {GravityModel::Somigliana, GravityModel::Series}) {
    const Gravity gravity(model);
    const NavState state = flying();
    const Vector3 f_n = matrix_from_quaternion(state.q_nb) * kForce_b;
    expect_blocks_equal(measured_dynamics(gravity), error_dynamics(state.position, state.v_n, f_n, gravity));
  }
}

TEST(ErrorDynamics, AtRestHaveTheSchulerFrequency) {
  const Gravity gravity;
  const Geodetic position{30.0 * units::kDeg, 0.0, 0.0};
  const double g = gravity.g_n(position).z();
  const Matrix9 F = error_dynamics(position, Vector3::Zero(), {0.0, 0.0, -g}, gravity);
  EXPECT_DOUBLE_EQ(F(3, 7) * F(7, 3), -g / wgs84::meridian_radius_m(position.latitude_rad));
  EXPECT_DOUBLE_EQ(F(4, 6) * F(6, 4), -g / wgs84::transverse_radius_m(position.latitude_rad));
}

}  // namespace error_model_test
}  // namespace inslab::nav
