#include "inslab/models/imu/size_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

/// Accelerometers that do not sit at one point.
namespace inslab::imu {
namespace size_effect_test {

const nav::Gravity kGravity;
constexpr std::int64_t kPeriodNs = 5000000;

ImuModel::Setup spread() {
  ImuModel::Setup setup{42, 0, time::Rate(200.0), kGravity, {}, {}, {}};
  setup.errors.accel_place_m << 0.02, 0.01, -0.03, -0.01, 0.03, 0.005, 0.015, 0.02, -0.02;
  return setup;
}
Vector3 place(int axis) { return spread().errors.accel_place_m.segment<3>(3 * axis); }

TEST(SizeEffect, OfASteadyTurnIsCentripetalAlongEachAxis) {
  // About z at 2 rad/s: -w^2 x of accelerometer x at (0.02, ...), -w^2 y of accelerometer y, nothing of z.
  const SizeEffect effect(spread().errors.accel_place_m);
  const Vector3 felt = effect.of_rate({0.0, 0.0, 2.0});
  EXPECT_NEAR(felt.x(), -4.0 * 0.02, 1e-17);
  EXPECT_NEAR(felt.y(), -4.0 * 0.03, 1e-17);
  EXPECT_NEAR(felt.z(), 0.0, 1e-17);
}

TEST(SizeEffect, OfAnAngularAccelerationIsAcrossTheArm) {
  // alpha x r of 3 rad/s^2 about z: (-3 y, 3 x, 0), each of its own accelerometer.
  const SizeEffect effect(spread().errors.accel_place_m);
  const Vector3 felt = effect.of_alpha({0.0, 0.0, 3.0});
  EXPECT_NEAR(felt.x(), -3.0 * 0.01, 1e-17);
  EXPECT_NEAR(felt.y(), 3.0 * -0.01, 1e-17);
  EXPECT_EQ(felt.z(), 0.0);
}

TEST(SizeEffect, OfATumblingMotionIsItsIntegralOverEachInterval) {
  // What a quadratic rate leaves out of the square: |w'| |w'''| r dt^5 / 360 < 4 * 4 * 0.04 * 3e-12 / 360 = 6e-15; the
  // five-point derivative is good to 1e-9 rad/s^2, of 5 ms and 4 cm 2e-13.
  const test::AnalyticMotion motion;
  ImuModel model(spread());
  constexpr double h = 1e-3;
  const auto felt = [&](double t) {
    const Vector3 w = motion.omega_iv_v(t);
    const Vector3 alpha = (8.0 * (motion.omega_iv_v(t + h) - motion.omega_iv_v(t - h)) -
                           (motion.omega_iv_v(t + 2 * h) - motion.omega_iv_v(t - 2 * h))) /
                          (12.0 * h);
    Vector3 along;
    for (int axis = 0; axis < 3; ++axis) {
      along[axis] = (alpha.cross(place(axis)) + w.cross(w.cross(place(axis))))[axis];
    }
    return along;
  };
  for (std::int64_t k = 0; k < 200; ++k) {
    const auto output = model.measure(motion.truth(k, kPeriodNs, kGravity));
    if (k == 0) continue;
    const double to = time::to_seconds(k * kPeriodNs);
    const Vector3 expected = test::integral(felt, to - 5e-3, to);
    EXPECT_LT((output->truth.accel_error.size_effect - expected).norm(), 1e-12) << k;
    EXPECT_LT((output->sample.dv_b - output->truth.dv_b - expected).norm(), 1e-12) << k;
    EXPECT_EQ(output->sample.dtheta_b, output->truth.dtheta_b);
    EXPECT_GT(expected.norm(), 1e-6);
  }
}

TEST(SizeEffect, OfAJumpOfTheRateIsAnImpulse) {
  // A rate about z that jumps by 1 rad/s at the end of the interval: -y and x of the places, m/s.
  ImuModel model(spread());
  TruthState truth;
  model.measure(truth);
  truth.header.sim_time_ns = truth.interval_ns = kPeriodNs;
  truth.rate_jump = true;
  truth.omega_iv_v.z() = 1.0;
  const auto output = model.measure(truth);
  EXPECT_NEAR(output->truth.accel_error.size_effect.x(), -0.01, 1e-16);
  EXPECT_NEAR(output->truth.accel_error.size_effect.y(), -0.01, 1e-16);
}

TEST(SizeEffect, OnAMovingMountFollowsItsTurning) {
  // W sin(2 pi f t) about z of a vehicle that does not turn: w' x r and -w^2 r in closed form. Gauss's sum leaves 1e-8.
  ImuModel::Setup setup = spread();
  setup.vibration.domain = VibrationDomain::Motion;
  setup.vibration.angular.push_back({Vector3(0.0, 0.0, 100.0), 30.0, Vector3::Zero()});
  ImuModel model(setup);
  const double W = 100.0 * units::kDeg, p = 2.0 * units::kPi * 30.0;
  for (std::int64_t k = 0; k < 50; ++k) {
    TruthState truth;
    truth.header.sim_time_ns = k * kPeriodNs;
    truth.interval_ns = k == 0 ? 0 : kPeriodNs;
    const auto output = model.measure(truth);
    if (k == 0) continue;
    const double b = time::to_seconds(k * kPeriodNs), a = b - 5e-3;
    const double change = W * (std::sin(p * b) - std::sin(p * a));
    const double square = 0.5 * W * W * (b - a - (std::sin(2.0 * p * b) - std::sin(2.0 * p * a)) / (2.0 * p));
    const Vector3 expected(-0.01 * change - 0.02 * square, -0.01 * change - 0.03 * square, 0.0);
    EXPECT_LT((output->truth.accel_error.size_effect - expected).norm(), 1e-8 * 0.04 * W) << k;
  }
}

TEST(SizeEffect, PassesTheBandwidthOfItsAccelerometer) {
  // A rate about z of W sin(p t) for a truth of 1 kHz, a filter of first order: H(f) times alpha x r, and of the square
  // its mean and H(2f) times the rest.
  ImuModel::Setup setup = spread();
  setup.imu_rate = time::Rate(1000.0);
  setup.errors.accel.bandwidth_hz.setConstant(20.0);
  ImuModel model(setup);
  const double W = 0.5, f = 2.0, p = 2.0 * units::kPi * f, h = 1e-3;
  const auto H = [](double frequency_hz) { return 1.0 / std::complex<double>(1.0, frequency_hz / 20.0); };
  for (std::int64_t k = 0; k < 1500; ++k) {
    TruthState truth;
    const double t = h * static_cast<double>(k), before = t - h;
    truth.header.sim_time_ns = k * 1000000;
    truth.omega_iv_v.z() = W * std::sin(p * t);
    if (k > 0) {
      truth.interval_ns = 1000000;
      truth.dtheta_v.z() = W / p * (std::cos(p * before) - std::cos(p * t));
    }
    const auto output = model.measure(truth);
    if (k < 500) continue;  // what the start left: exp(-2 pi 20 0.5) = 5e-28
    const double middle = t - 0.5 * h, x = p * h / 2.0;
    const double gain = h * std::sin(x) / x, twice = h * std::sin(2.0 * x) / (2.0 * x);
    const double alpha = (W * p * gain * H(f) * std::polar(1.0, p * middle)).real();
    const double square = 0.5 * W * W * (h - (twice * H(2.0 * f) * std::polar(1.0, 2.0 * p * middle)).real());
    // alpha of a quadratic rate errs by w''' h^2 / 12 at the ends, of second order as with an arm: 1e-4 of it.
    EXPECT_NEAR(output->sample.dv_b.x(), -0.01 * alpha - 0.02 * square, 1e-4 * 0.01 * W * p * h) << k;
  }
}

}  // namespace size_effect_test
}  // namespace inslab::imu
