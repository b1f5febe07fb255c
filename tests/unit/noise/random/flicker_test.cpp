#include "inslab/noise/random/flicker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace inslab::random {
namespace flicker_test {

constexpr double kB = 2.0;

/// Allan variance at `tau_s` of a continuous Gauss-Markov process: IEEE Std 952-1997, (C.11), for sigma.
double gauss_markov_allan_variance(double sigma, double correlation_time_s, double tau_s) {
  const double r = tau_s / correlation_time_s;
  return 2.0 * sigma * sigma / r * (1.0 - (3.0 - 4.0 * std::exp(-r) + std::exp(-2.0 * r)) / (2.0 * r));
}

double allan_deviation(double tau_s) {
  double variance = 0.0;
  for (int i = 0; i < Flicker::kTerms; ++i) {
    variance += gauss_markov_allan_variance(Flicker::kSigmaPerInstability * kB, Flicker::correlation_time_s(i), tau_s);
  }
  return std::sqrt(variance);
}

TEST(Flicker, TheSumOfItsProcessesHasAFlatAllanDeviationOf0664B) {
  const double level = std::sqrt(2.0 * std::log(2.0) / 3.14159265358979323846) * kB;
  for (double tau_s = 14.0; tau_s < 20000.0; tau_s *= 1.3) EXPECT_NEAR(allan_deviation(tau_s), level, 0.035 * level);
  for (const double tau_s : {3.0, 65536.0}) EXPECT_NEAR(allan_deviation(tau_s), level, 0.11 * level);
}

TEST(Flicker, DifferencesOverAnyLagHaveTheVarianceOfThatSum) {
  // D(tau) = sum of 2 sigma^2 (1 - exp(-tau/T)), at multiples of 16 s, where all terms up to T = 1024 s step. 1500
  // noises: relative standard error sqrt(2/1500) = 3.7 %.
  constexpr double kDt = 0.25;
  constexpr int kNoises = 1500;
  const double sigma = Flicker::kSigmaPerInstability * kB;
  for (const double tau_s : {1.0, 16.0, 64.0}) {
    const auto steps = static_cast<std::uint64_t>(tau_s / kDt);
    double squares = 0.0, expected = 0.0;
    for (int i = 0; i < kNoises; ++i) {
      Flicker flicker(kB, kDt, Stream(11, "flicker" + std::to_string(i)));
      const double before = flicker.value();
      for (std::uint64_t k = 0; k < steps; ++k) flicker.advance(k);
      squares += (flicker.value() - before) * (flicker.value() - before);
    }
    for (int i = 0; i < Flicker::kTerms; ++i) {
      const double T = Flicker::correlation_time_s(i);
      const double held_s = std::max(kDt, std::exp2(std::floor(std::log2(T / 64.0 / kDt))) * kDt);
      const double stepped_s = std::floor(tau_s / held_s) * held_s;
      expected += -2.0 * sigma * sigma * std::expm1(-stepped_s / T);
    }
    EXPECT_NEAR(squares / kNoises, expected, 4.0 * 0.037 * expected) << tau_s;
  }
}

TEST(Flicker, BeginsWithItsSteadySpread) {
  // 9 processes of variance sigma^2; 4000 noises: sqrt(2/4000) = 2.2 %.
  double squares = 0.0;
  for (int i = 0; i < 4000; ++i) {
    squares += std::pow(Flicker(kB, 0.01, Stream(11, "flicker" + std::to_string(i))).value(), 2);
  }
  const double expected = Flicker::kTerms * std::pow(Flicker::kSigmaPerInstability * kB, 2);
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
