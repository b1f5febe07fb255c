#include "inslab/models/imu/vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {
namespace vibration_test {

constexpr std::int64_t kPeriodNs = 5000000;
const Vibration::Setup kSetup{5e-3, 42, "imu0"};

VibrationProfile linear_x(double amplitude_m_per_s2, double frequency_hz, double phase_deg) {
  VibrationProfile profile;
  profile.linear.push_back({Vector3(amplitude_m_per_s2, 0.0, 0.0), frequency_hz, Vector3(phase_deg, 0.0, 0.0)});
  return profile;
}

/// Simpson's rule; n intervals of h leave (b - a) h^4 / 180 of the fourth derivative.
double simpson(const std::function<double(double)>& f, double a, double b, int n) {
  const double h = (b - a) / n;
  double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i) sum += f(a + i * h) * (i % 2 == 1 ? 4.0 : 2.0);
  return sum * h / 3.0;
}

TEST(Vibration, AnIntervalHoldsTheIntegralOfTheSinusoid) {
  Vibration vibration(linear_x(3.0, 12.5, 30.0), kSetup);
  for (std::int64_t k = 0; k < 400; ++k) {
    const double w = 2.0 * units::kPi * 12.5, phase = units::kPi / 6.0;
    const double t0 = static_cast<double>(k) * 5e-3, t1 = t0 + 5e-3;
    const double exact = 3.0 / w * (std::cos(w * t0 + phase) - std::cos(w * t1 + phase));
    // The test's own difference of cosines: 3/w * 1e-16 * the phase of 157 rad.
    EXPECT_NEAR(vibration.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(), exact, 2e-15) << k;
  }
}

TEST(Vibration, AnglesAreInRadiansAndEveryAxisHasItsOwnAmplitudeAndPhase) {
  VibrationProfile profile;
  profile.angular.push_back({Vector3(90.0, 45.0, 0.0), 1.0, Vector3(0.0, 90.0, 0.0)});
  Vibration vibration(profile, kSetup);
  const Increments out = vibration.increments(0, 250000000);  // a quarter period
  // Integral of sin over a quarter: 1/(2 pi); of cos: the same.
  EXPECT_NEAR(out.dtheta.x(), 0.5 * units::kPi / (2.0 * units::kPi), 1e-15);
  EXPECT_NEAR(out.dtheta.y(), 0.25 * units::kPi / (2.0 * units::kPi), 1e-15);
  EXPECT_EQ(out.dtheta.z(), 0.0);
  EXPECT_EQ(out.dv, Vector3::Zero());
}

TEST(Vibration, AFrequencyAboveHalfTheSampleRateLeavesItsIntegralAndNoAlias) {
  // 200 Hz sampled at 200 Hz: whole periods, so nothing is left where instantaneous samples would show a constant.
  Vibration whole(linear_x(10.0, 200.0, 90.0), kSetup);
  // 210 Hz: a tenth of a period more; the integral is a/(pi f) sin(pi f dt), not a dt.
  Vibration more(linear_x(10.0, 210.0, 90.0), kSetup);
  double largest = 0.0;
  for (std::int64_t k = 0; k < 200; ++k) {
    EXPECT_NEAR(whole.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(), 0.0, 1e-15);
    largest = std::max(largest, std::abs(more.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x()));
  }
  // The phase of the middles steps by a twentieth of a turn: the largest of them is within cos(pi/20) of the peak.
  const double peak = 10.0 / (units::kPi * 210.0) * std::abs(std::sin(units::kPi * 210.0 * 5e-3));
  EXPECT_LE(largest, peak * (1.0 + 1e-12));
  EXPECT_GE(largest, peak * std::cos(units::kPi / 20.0));
}

TEST(Vibration, IncrementsAddUpToTheIntegralOfTheWhole) {
  Vibration vibration(linear_x(2.0, 33.3, 12.0), kSetup);
  double sum = 0.0;
  for (std::int64_t k = 0; k < 20000; ++k) sum += vibration.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x();
  const double w = 2.0 * units::kPi * 33.3, phase = 12.0 * units::kPi / 180.0;
  const double exact = 2.0 / w * (std::cos(phase) - std::cos(w * 100.0 + phase));
  EXPECT_NEAR(sum, exact, 2e-14);  // 20000 roundings of 0.01: sqrt(20000) * 1e-18, and 2e4 rad * 1e-16 * 2/w
}

TEST(Vibration, PrecisionDoesNotFadeInAWeek) {
  // 1000.125 Hz is exact in binary and makes a whole number of turns in a week.
  Vibration vibration(linear_x(1.0, 1000.125, 77.0), kSetup);
  constexpr std::int64_t kWeekNs = 604800LL * 1000000000LL;
  for (std::int64_t k = 0; k < 100; ++k) {
    const double at_start = vibration.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x();
    const double a_week_on = vibration.increments(kWeekNs + k * kPeriodNs, kWeekNs + (k + 1) * kPeriodNs).dv.x();
    EXPECT_NEAR(a_week_on, at_start, 1e-18);  // increments of 3e-4 * 4e-15
  }
}

TEST(Vibration, ASwapWithoutAFadeTakesEffectAtOnce) {
  Vibration vibration(linear_x(1.0, 10.0, 0.0), kSetup);
  vibration.swap(VibrationProfile(), 40 * kPeriodNs, 0.0);
  EXPECT_EQ(vibration.increments(40 * kPeriodNs, 41 * kPeriodNs).dv, Vector3::Zero());
}

double rise(double t, double start, double length) {
  const double tau = (t - start) / length;
  return tau <= 0.0 ? 0.0 : tau >= 1.0 ? 1.0 : 0.5 - 0.5 * std::cos(units::kPi * tau);
}

TEST(Vibration, AFadeIsIntegratedExactlyThroughItsEndInsideAnInterval) {
  // From 9.5 Hz at 2 m/s^2 to 170 Hz at 5 m/s^2 in 0.4321 s from 0.1 s on.
  Vibration vibration(linear_x(2.0, 9.5, 20.0), kSetup);
  const auto mixed = [](double t) {
    const double w = rise(t, 0.1, 0.4321);
    return (1.0 - w) * 2.0 * std::sin(2.0 * units::kPi * 9.5 * t + units::kPi / 9.0) +
           w * 5.0 * std::sin(2.0 * units::kPi * 170.0 * t - units::kPi / 2.0);
  };
  for (std::int64_t k = 0; k < 150; ++k) {
    if (k == 20) vibration.swap(linear_x(5.0, 170.0, -90.0), k * kPeriodNs, 0.4321);
    const double t0 = static_cast<double>(k) * 5e-3, t1 = t0 + 5e-3;
    // Simpson: 5e-3 * (2.5e-5)^4 / 180 * 5 * (2 pi 170)^4 = 7e-11 of 1e-2; at the fade's end the second derivative
    // jumps inside a step: 5 * (pi/0.4321)^2/2 * h^3 = 2e-12.
    EXPECT_NEAR(vibration.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(), simpson(mixed, t0, t1, 200), 1e-10)
        << k;
  }
}

TEST(Vibration, AFadeOfTheSameProfileChangesNothing) {
  // The weights of both sum to 1 at every instant; 1e-17 is the rounding of increments of 1e-2.
  Vibration still(linear_x(2.0, 9.5, 20.0), kSetup), swapped(linear_x(2.0, 9.5, 20.0), kSetup);
  for (std::int64_t k = 0; k < 300; ++k) {
    if (k == 20) swapped.swap(linear_x(2.0, 9.5, 20.0), k * kPeriodNs, 1.0);
    if (k == 90) swapped.swap(linear_x(2.0, 9.5, 20.0), k * kPeriodNs, 0.5);
    EXPECT_NEAR(swapped.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(),
                still.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(), 1e-17)
        << k;
  }
}

TEST(Vibration, ASwapDuringAFadeGoesOnSmoothlyFromWhereItIs) {
  // a -> b (1 s from 0.1 s), b -> c (0.4 s from 0.3 s): weights (1 - r1)(1 - r2), r1 (1 - r2), r2.
  Vibration vibration(linear_x(1.0, 5.0, 0.0), kSetup);
  const auto mixed = [](double t) {
    const double r1 = rise(t, 0.1, 1.0), r2 = rise(t, 0.3, 0.4);
    return (1.0 - r1) * (1.0 - r2) * std::sin(2.0 * units::kPi * 5.0 * t) +
           r1 * (1.0 - r2) * 2.0 * std::sin(2.0 * units::kPi * 7.0 * t) +
           r2 * 3.0 * std::sin(2.0 * units::kPi * 11.0 * t);
  };
  for (std::int64_t k = 0; k < 200; ++k) {
    if (k == 20) vibration.swap(linear_x(2.0, 7.0, 0.0), k * kPeriodNs, 1.0);
    if (k == 60) vibration.swap(linear_x(3.0, 11.0, 0.0), k * kPeriodNs, 0.4);
    const double t0 = static_cast<double>(k) * 5e-3, t1 = t0 + 5e-3;
    EXPECT_NEAR(vibration.increments(k * kPeriodNs, (k + 1) * kPeriodNs).dv.x(), simpson(mixed, t0, t1, 200), 1e-12)
        << k;
  }
}

TEST(Vibration, AThirdFadeEndsTheFirstAtOnce) {
  Vibration vibration(linear_x(100.0, 5.0, 0.0), kSetup);
  vibration.swap(linear_x(0.0, 7.0, 0.0), 0, 10.0);
  vibration.swap(linear_x(0.0, 9.0, 0.0), 0, 10.0);
  EXPECT_NE(vibration.increments(0, kPeriodNs).dv.x(), 0.0);
  vibration.swap(linear_x(0.0, 11.0, 0.0), kPeriodNs, 10.0);
  EXPECT_EQ(vibration.increments(kPeriodNs, 2 * kPeriodNs).dv.x(), 0.0);
}

}  // namespace vibration_test
}  // namespace inslab::imu
