#include "inslab/nav/strapdown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/nav/closed_form_motion.hpp"

namespace inslab::nav {
namespace strapdown_test {

constexpr double kDt_s = 0.005;
constexpr Strapdown::Options kAsPrinted{false};
constexpr Strapdown::Options kFullRotation{true};

struct Error {
  double position_m;
  double velocity_m_per_s;
  double attitude_rad;
};

Error error_of(const NavState& found, const NavState& truth) {
  return {ned_from(truth.position, found.position).norm(), (found.v_n - truth.v_n).norm(),
          angle_between(found.q_nb, truth.q_nb)};
}

/// The error after `pairs` pairs of intervals, (1 + unevenness) and (1 - unevenness) times `dt_s`, begun with the
/// knowledge of the interval before.
Error error_after(const ClosedFormMotion& motion, int pairs, double dt_s, const Strapdown::Options& options,
                  double unevenness = 0.0) {
  Strapdown strapdown(motion.state(0.0), motion.gravity, options, motion.increments(-dt_s, 0.0));
  for (int k = 0; k < pairs; ++k) {
    const double start_s = 2 * k * dt_s, joint_s = start_s + (1.0 + unevenness) * dt_s, end_s = (2 * k + 2) * dt_s;
    strapdown.advance(motion.increments(start_s, joint_s));
    strapdown.advance(motion.increments(joint_s, end_s));
  }
  return error_of(strapdown.state(), motion.state(2 * pairs * dt_s));
}

/// log2 of how much each error falls when the interval is halved.
struct Orders {
  double position;
  double velocity;
  double attitude;
};
/// Over 10 s, a whole number of periods of the motions here: what swings with the acceleration itself is 0 there.
Orders orders(const ClosedFormMotion& motion, const Strapdown::Options& options, double unevenness = 0.0) {
  const Error coarse = error_after(motion, 500, 0.01, options, unevenness);
  const Error fine = error_after(motion, 1000, 0.005, options, unevenness);
  return {std::log2(coarse.position_m / fine.position_m), std::log2(coarse.velocity_m_per_s / fine.velocity_m_per_s),
          std::log2(coarse.attitude_rad / fine.attitude_rad)};
}

TEST(Strapdown, AtRestDoesNotDriftForTwentyMinutes) {
  ClosedFormMotion rest;
  rest.q_nb = [](double) { return quaternion_from_rpy({0.2, -0.3, 4.0}); };
  for (const double rate_hz : {200.0, 1000.0}) {
    const double dt_s = 1.0 / rate_hz, t_s = 1200.0;
    Strapdown strapdown(rest.state(0.0), rest.gravity, kAsPrinted);
    const ImuIncrements imu = rest.increments(0.0, dt_s);
    for (int k = 0; k < 1200 * static_cast<int>(rate_hz); ++k) strapdown.advance(imu);
    const Error error = error_of(strapdown.state(), rest.state(0.0));
    // The turn of the Earth in second order, which the algorithm leaves out: 1/6 of (2-32) and 1/4 of (2-33).
    const double truncation_m_per_s2 = 5.0 / 12.0 * std::pow(wgs84::omega_e_rad_per_s * dt_s, 2.0) * 9.8;
    EXPECT_LT(error.position_m, 0.5 * truncation_m_per_s2 * t_s * t_s + 5e-9) << rate_hz;
    EXPECT_LT(error.velocity_m_per_s, truncation_m_per_s2 * t_s + 5e-12) << rate_hz;
    EXPECT_LT(error.attitude_rad, truncation_m_per_s2 * t_s * t_s / 2.0 / wgs84::b_m + 1e-14) << rate_hz;
  }
}

TEST(Strapdown, FollowsAParallelThroughTheAntimeridian) {
  const Gravity gravity;
  const Vector3 v_n(0.0, 250.0, 0.0);
  const Geodetic start{-40.0 * units::kDeg, 179.0 * units::kDeg, 10000.0};
  const Vector3 omega_ie = omega_ie_n(start.latitude_rad), omega_en = omega_en_n(start, v_n);
  const ImuIncrements imu{kDt_s * (omega_ie + omega_en),
                          kDt_s * ((2.0 * omega_ie + omega_en).cross(v_n) - gravity.g_n(start)), kDt_s};
  Strapdown strapdown({start, v_n, Quaternion::Identity()}, gravity, kAsPrinted, imu);
  for (int k = 0; k < 240000; ++k) strapdown.advance(imu);
  const double radius_m =
      (wgs84::transverse_radius_m(start.latitude_rad) + start.height_m) * std::cos(start.latitude_rad);
  const double longitude_rad = wrapped_to_pi(start.longitude_rad + 1200.0 * v_n.y() / radius_m);
  const Error error =
      error_of(strapdown.state(), {{start.latitude_rad, longitude_rad, start.height_m}, v_n, Quaternion::Identity()});
  EXPECT_LT(longitude_rad, 0.0);
  // The turn of n in second order, as at rest, but faster.
  const double zeta_rad = (omega_ie + omega_en).norm() * kDt_s;
  const double truncation_m_per_s2 = 5.0 / 12.0 * zeta_rad * zeta_rad * 9.8;
  EXPECT_LT(error.velocity_m_per_s, truncation_m_per_s2 * 1200.0);
  EXPECT_LT(error.position_m, truncation_m_per_s2 * 1200.0 * 1200.0 / 2.0);
  EXPECT_LT(error.attitude_rad, error.position_m / wgs84::b_m);
}

/// 30 deg/s about the vertical, tilted.
ClosedFormMotion turntable(double rate_rad_per_s) {
  ClosedFormMotion motion;
  const Quaternion tilted = quaternion_from_rpy({0.3, -0.2, 0.0});
  motion.q_nb = [=](double t_s) { return quaternion_from_rotation_vector({0.0, 0.0, rate_rad_per_s * t_s}) * tilted; };
  motion.omega_nb_b = [=](double) { return tilted.conjugate() * Vector3(0.0, 0.0, rate_rad_per_s); };
  return motion;
}

TEST(Strapdown, AtAConstantRateDriftsAsPrintedByTheRotationTermItDrops) {
  const double Omega = 30.0 * units::kDeg, t_s = 60.0;
  const ClosedFormMotion motion = turntable(Omega);
  // 1/6 dtheta x (dtheta x dv) of every interval, dtheta turning about the vertical and with the Earth.
  const Vector3 g_n = motion.gravity.g_n(motion.place);
  const double dropped_m_per_s2 =
      kDt_s * kDt_s / 6.0 * Vector3(0.0, 0.0, Omega).cross(omega_ie_n(motion.place.latitude_rad).cross(-g_n)).norm();
  const Error error = error_after(motion, 6000, kDt_s, kAsPrinted);
  EXPECT_NEAR(error.velocity_m_per_s, dropped_m_per_s2 * t_s, 0.02 * dropped_m_per_s2 * t_s);
  EXPECT_NEAR(error.position_m, dropped_m_per_s2 * t_s * t_s / 2.0, 0.02 * dropped_m_per_s2 * t_s * t_s / 2.0);
}

TEST(Strapdown, AtAConstantRateTheFullRotationTermLeavesAThirdOrderTilt) {
  const double Omega = 30.0 * units::kDeg, t_s = 60.0;
  const ClosedFormMotion motion = turntable(Omega);
  // In b the Earth's rate turns with Omega: what (2-51) drops of the Bortz equation is then omega_ie (Omega dt)^3/24.
  const double tilt_rad_per_s = omega_ie_n(motion.place.latitude_rad).x() * std::pow(Omega * kDt_s, 3.0) / 24.0;
  const Error error = error_after(motion, 6000, kDt_s, kFullRotation);
  EXPECT_NEAR(error.attitude_rad, tilt_rad_per_s * t_s, 0.02 * tilt_rad_per_s * t_s);
  EXPECT_LT(error.velocity_m_per_s, 9.8 * tilt_rad_per_s * t_s * t_s / 2.0 * 1.02);
}

TEST(Strapdown, AttitudeIsOfFourthOrderInConing) {
  EXPECT_NEAR(orders(coning_motion(2.0 * units::kDeg, 0.5), kAsPrinted).attitude, 4.0, 0.1);
}

TEST(Strapdown, VelocityAndPositionAreOfSecondOrderInScullingAsPrinted) {
  const Orders found = orders(sculling_motion(2.0 * units::kDeg, 5.0, 0.5), kAsPrinted);
  EXPECT_NEAR(found.velocity, 2.0, 0.1);
  EXPECT_NEAR(found.position, 2.0, 0.1);
}

TEST(Strapdown, VelocityAndPositionAreOfFourthOrderInScullingWithTheFullRotationTerm) {
  const Orders found = orders(sculling_motion(2.0 * units::kDeg, 5.0, 0.5), kFullRotation);
  EXPECT_NEAR(found.velocity, 4.0, 0.1);
  EXPECT_NEAR(found.position, 4.0, 0.1);
}

TEST(Strapdown, KeepsItsOrderOnUnevenIntervals) {
  const double unevenness = 0.4;
  EXPECT_NEAR(orders(coning_motion(2.0 * units::kDeg, 0.5), kFullRotation, unevenness).attitude, 4.0, 0.2);
  EXPECT_NEAR(orders(sculling_motion(2.0 * units::kDeg, 5.0, 0.5), kFullRotation, unevenness).velocity, 4.0, 0.2);
}

TEST(Strapdown, InverseArrivesAtTheVelocityAndAttitudeAskedFor) {
  const ClosedFormMotion motion = sculling_motion(5.0 * units::kDeg, 5.0, 0.5);
  for (const Strapdown::Options& options : {kAsPrinted, kFullRotation}) {
    Strapdown strapdown(motion.state(0.0), motion.gravity, options);
    double t_s = 0.0, velocity_m_per_s = 0.0, attitude_rad = 0.0;
    for (int k = 1; k <= 1000; ++k) {
      const double dt_s = k % 3 == 0 ? 0.002 : 0.005;
      const NavState target = motion.state(t_s += dt_s);
      strapdown.advance(strapdown.increments_to(target.v_n, target.q_nb, dt_s));
      velocity_m_per_s = std::max(velocity_m_per_s, (strapdown.v_n() - target.v_n).norm());
      attitude_rad = std::max(attitude_rad, angle_between(strapdown.q_nb(), target.q_nb));
    }
    EXPECT_LT(velocity_m_per_s, 1e-14);
    EXPECT_LT(attitude_rad, 1e-15);
  }
}

TEST(Strapdown, InverseGivesBackTheIncrements) {
  const ClosedFormMotion motion = coning_motion(2.0 * units::kDeg, 0.5);
  Strapdown strapdown(motion.state(0.0), motion.gravity, kFullRotation);
  double dtheta_rad = 0.0, dv_m_per_s = 0.0;
  for (int k = 1; k <= 1000; ++k) {
    const ImuIncrements imu = motion.increments((k - 1) * kDt_s, k * kDt_s);
    Strapdown next = strapdown;
    next.advance(imu);
    const ImuIncrements found = strapdown.increments_to(next.v_n(), next.q_nb(), imu.dt_s);
    dtheta_rad = std::max(dtheta_rad, (found.dtheta_b - imu.dtheta_b).norm());
    dv_m_per_s = std::max(dv_m_per_s, (found.dv_b - imu.dv_b).norm());
    strapdown = next;
  }
  // Attitude is given back to the rounding of two quaternions of norm 1.
  EXPECT_LT(dtheta_rad, 1e-15);
  EXPECT_LT(dv_m_per_s, 1e-15);
}

TEST(Strapdown, RefusesAnIntervalThatIsNotPositive) {
  const ClosedFormMotion rest;
  Strapdown strapdown(rest.state(0.0), rest.gravity, kAsPrinted);
  for (const double dt_s : {0.0, -0.005, std::nan("")}) {
    EXPECT_THROW(strapdown.advance({Vector3::Zero(), Vector3::Zero(), dt_s}), std::invalid_argument);
    EXPECT_THROW(strapdown.increments_to(Vector3::Zero(), Quaternion::Identity(), dt_s), std::invalid_argument);
    EXPECT_THROW(
        Strapdown(rest.state(0.0), rest.gravity, kAsPrinted, ImuIncrements{Vector3::Zero(), Vector3::Zero(), dt_s}),
        std::invalid_argument);
  }
}

TEST(Strapdown, RefusesAStartOutsideTheDomain) {
  NavState pole = ClosedFormMotion().state(0.0);
  pole.position.latitude_rad = 90.0 * units::kDeg;
  EXPECT_THROW(Strapdown(pole, Gravity(), kAsPrinted), std::domain_error);
}

}  // namespace strapdown_test
}  // namespace inslab::nav
