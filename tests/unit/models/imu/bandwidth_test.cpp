#include "inslab/models/imu/bandwidth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {
namespace bandwidth_test {

constexpr double kDt = 0.001;

Bandwidth made(FilterOrder order, double bandwidth_hz) {
  TriadParameters parameters;
  parameters.bandwidth_hz = {bandwidth_hz, 0.0, 0.0};
  parameters.bandwidth_order = order;
  return {parameters, kDt};
}

/// Runs a unit step (0 for the first interval, then 1) through the filter and returns the output of interval n.
double step_increment(FilterOrder order, double bandwidth_hz, int n) {
  Bandwidth filter = made(order, bandwidth_hz);
  filter.filtered(Vector3::Zero());
  double out = 0.0;
  for (int k = 0; k < n; ++k) out = filter.filtered({kDt, kDt, kDt}).x();
  return out;
}

TEST(Bandwidth, FirstOrderIntegratesItsStepResponse) {
  // y = 1 - exp(-w t); integral over ((n-1) dt, n dt].
  const double w = 2.0 * units::kPi * 20.0;
  for (const int n : {1, 5, 50}) {
    const double t0 = (n - 1) * kDt, t1 = n * kDt;
    const double exact = kDt + (std::exp(-w * t1) - std::exp(-w * t0)) / w;
    EXPECT_NEAR(step_increment(FilterOrder::First, 20.0, n), exact, 1e-17);
  }
}

TEST(Bandwidth, SecondOrderIntegratesItsStepResponse) {
  // y = 1 - exp(-s t) (cos s t + sin s t), s = w/sqrt 2; its antiderivative is t + exp(-s t) cos(s t)/s.
  const double s = 2.0 * units::kPi * 20.0 / std::sqrt(2.0);
  const auto integral = [s](double t) { return t + std::exp(-s * t) * std::cos(s * t) / s; };
  for (const int n : {1, 5, 50}) {
    EXPECT_NEAR(step_increment(FilterOrder::Second, 20.0, n), integral(n * kDt) - integral((n - 1) * kDt), 1e-16);
  }
}

/// Amplitude of the output of a sinusoid of `frequency_hz` against that of its input, once settled.
double gain(FilterOrder order, double bandwidth_hz, double frequency_hz) {
  Bandwidth filter = made(order, bandwidth_hz);
  std::complex<double> in = 0.0, out = 0.0;
  const int period = static_cast<int>(std::lround(1.0 / (frequency_hz * kDt)));
  for (int k = 0; k < 60 * period; ++k) {
    const double phase = 2.0 * units::kPi * k / period;
    const double x = std::sin(phase);
    const double y = filter.filtered({x, 0.0, 0.0}).x();
    if (k < 50 * period) continue;
    in += x * std::polar(1.0, -phase);
    out += y * std::polar(1.0, -phase);
  }
  return std::abs(out) / std::abs(in);
}

TEST(Bandwidth, IsThreeDecibelsDownAtTheBandwidthInBothOrders) {
  // 1/sqrt 2 but for the input held over each interval, which at 5 Hz and 1 kHz changes it by (pi f dt)^2 = 2.5e-4.
  EXPECT_NEAR(gain(FilterOrder::First, 5.0, 5.0), std::sqrt(0.5), 3e-4);
  EXPECT_NEAR(gain(FilterOrder::Second, 5.0, 5.0), std::sqrt(0.5), 3e-4);
}

TEST(Bandwidth, FallsWithItsOrder) {
  // A decade above: 1/sqrt(1 + 100) and 1/sqrt(1 + 10^4), here at 50 Hz, where held input changes it by 2.5 %.
  EXPECT_NEAR(gain(FilterOrder::First, 5.0, 50.0), 1.0 / std::sqrt(101.0), 0.025 / std::sqrt(101.0));
  EXPECT_NEAR(gain(FilterOrder::Second, 5.0, 50.0), 1.0 / std::sqrt(10001.0), 0.025 / std::sqrt(10001.0));
}

TEST(Bandwidth, LosesNoIncrements) {
  for (const FilterOrder order : {FilterOrder::First, FilterOrder::Second}) {
    Bandwidth filter = made(order, 3.0);
    double in = 0.0, out = 0.0;
    for (int k = 0; k < 5000; ++k) {
      const double x = k > 0 && k < 3000 ? std::sin(0.01 * k * k) + 0.3 : 0.0;  // then settles for 2 s: exp(-27)
      in += x;
      out += filter.filtered({x, 0.0, 0.0}).x();
    }
    EXPECT_NEAR(out, in, 1e-10 * in);
  }
}

TEST(Bandwidth, StartsSettledAndAgainAfterARestart) {
  Bandwidth filter = made(FilterOrder::Second, 3.0);
  EXPECT_DOUBLE_EQ(filter.filtered({5.0, 0.0, 0.0}).x(), 5.0);
  EXPECT_NE(filter.filtered({7.0, 0.0, 0.0}).x(), 7.0);
  filter.restart();
  EXPECT_DOUBLE_EQ(filter.filtered({7.0, 0.0, 0.0}).x(), 7.0);
}

TEST(Bandwidth, AnAxisWithoutOnePassesUnchanged) {
  Bandwidth filter = made(FilterOrder::First, 3.0);
  filter.filtered({1.0, 1.0, 1.0});
  EXPECT_EQ(filter.filtered({5.0, 6.0, 7.0}).tail<2>(), Eigen::Vector2d(6.0, 7.0));
}

}  // namespace bandwidth_test
}  // namespace inslab::imu
