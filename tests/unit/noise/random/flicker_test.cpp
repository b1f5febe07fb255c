#include "inslab/noise/random/flicker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace inslab::random {
namespace flicker_test {

constexpr double kB = 2.0;

/// Allan variance over m samples of a Gauss-Markov process held over each: sigma^2 / m^2 times the sum of the
/// autocorrelation p^|i - j| over all pairs of the 2 m samples, +1 within a half, -1 across, over 2.
double gauss_markov_allan_variance(const Flicker::Process& process, double dt_s, int m) {
  const double p = std::exp(-dt_s / process.correlation_time_s);
  double sum = 0.0, power = 1.0;
  for (int lag = 0; lag < 2 * m; ++lag, power *= p) {
    const int within = 2 * std::max(m - lag, 0), across = (2 * m - lag) - within;
    sum += (lag == 0 ? 1.0 : 2.0) * power * (within - across);
  }
  return process.sigma * process.sigma * sum / (2.0 * m * m);
}

double allan_deviation(double dt_s, int m) {
  double variance = 0.0;
  for (int i = 0; i < Flicker::terms(dt_s); ++i) {
    variance += kB * kB * gauss_markov_allan_variance(Flicker::process(i, dt_s), dt_s, m);
  }
  return std::sqrt(variance);
}

TEST(Flicker, HasAFlatAllanDeviationOf0664BFromOneSampleOn) {
  const double level = std::sqrt(2.0 * std::log(2.0) / 3.14159265358979323846) * kB;
  for (const double dt_s : {1e-4, 0.001, 0.005, 0.02, 1.0}) {
    for (int m = 1; m * std::max(dt_s, 1.0) < 20000.0; m = 1 + m * 5 / 4) {
      EXPECT_NEAR(allan_deviation(dt_s, m), level, (m * dt_s < 5000.0 ? 0.01 : 0.035) * level) << dt_s << " " << m;
    }
    for (const int m : {1, 3}) EXPECT_NEAR(allan_deviation(dt_s, m), level, 1e-3 * level) << dt_s;
  }
  for (int m = 1; m <= 65536; m *= 4) EXPECT_NEAR(allan_deviation(1.0, m), level, 0.11 * level) << m;
}

TEST(Flicker, DifferencesOverAnyLagHaveTheVarianceOfThatSum) {
  // D(tau) = sum of 2 sigma^2 (1 - exp(-tau/T)), each process as long as it has stepped. 1500 noises: relative standard
  // error sqrt(2/1500) = 3.7 %.
  constexpr double kDt = 0.25;
  constexpr int kNoises = 1500;
  for (const double tau_s : {0.25, 1.0, 16.0, 64.0}) {
    const auto steps = static_cast<std::uint64_t>(tau_s / kDt);
    double squares = 0.0, expected = 0.0;
    for (int i = 0; i < kNoises; ++i) {
      Flicker flicker(kB, kDt, Stream(11, "flicker" + std::to_string(i)));
      const double before = flicker.value();
      for (std::uint64_t k = 0; k < steps; ++k) flicker.advance(k);
      squares += (flicker.value() - before) * (flicker.value() - before);
    }
    for (int i = 0; i < Flicker::terms(kDt); ++i) {
      const auto [sigma, T] = Flicker::process(i, kDt);
      const double held_s = std::max(kDt, std::exp2(std::floor(std::log2(T / 64.0 / kDt))) * kDt);
      const double stepped_s = std::floor(tau_s / held_s) * held_s;
      expected += -2.0 * kB * kB * sigma * sigma * std::expm1(-stepped_s / T);
    }
    EXPECT_NEAR(squares / kNoises, expected, 4.0 * 0.037 * expected) << tau_s;
  }
}

TEST(Flicker, BeginsWithItsSteadySpread) {
  // 4000 noises: sqrt(2/4000) = 2.2 %.
  double squares = 0.0;
  for (int i = 0; i < 4000; ++i) {
    squares += std::pow(Flicker(kB, 0.01, Stream(11, "flicker" + std::to_string(i))).value(), 2);
  }
  double expected = 0.0;
  for (int i = 0; i < Flicker::terms(0.01); ++i) expected += std::pow(Flicker::process(i, 0.01).sigma * kB, 2);
  EXPECT_NEAR(squares / 4000.0, expected, 4.0 * 0.022 * expected);
}

TEST(Flicker, RetuneDoesNotJumpInUnitsOfSigmaAndResetIsZero) {
  Flicker flicker(kB, 0.01, Stream(11, "flicker"));
  const double before = flicker.value();
  flicker.retune(3.0 * kB);
  EXPECT_DOUBLE_EQ(flicker.value(), 3.0 * before);
  flicker.reset();
  EXPECT_EQ(flicker.value(), 0.0);
}

TEST(Flicker, RedrawDependsOnTheSampleAlone) {
  Flicker a(kB, 0.01, Stream(11, "flicker")), b = a;
  for (std::uint64_t k = 0; k < 100; ++k) a.advance(k);
  const double before = a.value();
  a.redraw(100);
  b.redraw(100);
  EXPECT_EQ(a.value(), b.value());
  EXPECT_NE(a.value(), before);
}

TEST(Flicker, RefusesWhatCannotBe) {
  const Stream stream(11, "flicker");
  EXPECT_THROW(Flicker(-1.0, 0.1, stream), std::invalid_argument);
  EXPECT_THROW(Flicker(1.0, 0.0, stream), std::invalid_argument);
}

}  // namespace flicker_test
}  // namespace inslab::random
