#include "inslab/noise/allan/noise_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::allan {
namespace noise_model_test {

NoiseModel gauss_markov(double sigma, double correlation_time_s) {
  NoiseModel model;
  model.gm_sigma = sigma;
  model.gm_correlation_time_s = correlation_time_s;
  return model;
}

/// The form as printed, in long double.
long double printed_gauss_markov(long double dt_s, long double correlation_time_s, long double m) {
  const long double p = std::exp(-dt_s / correlation_time_s);
  return (m - 3 * p - m * p * p + 4 * std::pow(p, m + 1) - std::pow(p, 2 * m + 1)) / (m * m * (1 - p) * (1 - p));
}

TEST(NoiseModel, HeldGaussMarkovIsThePrintedForm) {
  // The printed form at m = 1 is (dt/T)^3 out of terms of size 4 that a long double has to 1e-19: 4e-10 at dt/T = 1e-3.
  for (const double correlation_time_s : {0.5, 10.0, 100.0}) {
    for (const std::int64_t m : {1, 2, 10, 189, 1000, 100000}) {
      const double expected =
          static_cast<double>(printed_gauss_markov(0.1L, correlation_time_s, static_cast<long double>(m)));
      EXPECT_NEAR(allan_variance(gauss_markov(3.0, correlation_time_s), 0.1, m), 9.0 * expected, 1e-8 * expected)
          << correlation_time_s << " " << m;
    }
  }
}

TEST(NoiseModel, OneSampleOfALongGaussMarkovIsItsDrive) {
  // Neighbours differ by the drive and the decay: half of 2 sigma^2 (1 - p), at m = 1, where the printed form is noise.
  const double a = 0.005 / 14400.0;
  EXPECT_NEAR(allan_variance(gauss_markov(1.0, 14400.0), 0.005, 1) / -std::expm1(-a), 1.0, 1e-14);
}

TEST(NoiseModel, GaussMarkovPeaksAtItsKnownPlace) {
  // 0.617 sigma at 1.89 T (IEEE Std 952-1997, C.1.2).
  EXPECT_NEAR(std::sqrt(allan_variance(gauss_markov(1.0, 100.0), 0.01, 18900)), 0.617, 5e-4);
}

TEST(NoiseModel, CoefficientsAreThoseOfTheStandard) {
  EXPECT_NEAR(allan_variance({2.0, 0, 0, 0, 0, 0}, 0.5, 8), 4.0 / 4.0, 1e-15);
  EXPECT_NEAR(allan_variance({0, 2.0, 0, 0, 0, 0}, 0.5, 8), 3.0 * 4.0 / 16.0, 1e-15);
  EXPECT_NEAR(std::sqrt(allan_variance({0, 0, 1.0, 0, 0, 0}, 0.5, 1000)), 0.6643, 0.03 * 0.6643);
  EXPECT_NEAR(allan_variance({0, 0, 0, 3.0, 0, 0}, 0.5, 1000), 9.0 * 500.0 / 3.0 * (1.0 + 0.5e-6), 1e-10);
}

TEST(NoiseModel, AWalkIsAGaussMarkovBiasWithoutEnd) {
  // sigma^2 = K^2 T/2: relative difference of the order m dt/T.
  const double correlation_time_s = 1e9;
  for (const std::int64_t m : {1, 3, 100}) {
    const double walk = allan_variance({0, 0, 0, 1.0, 0, 0}, 1.0, m);
    const double process =
        allan_variance(gauss_markov(std::sqrt(correlation_time_s / 2.0), correlation_time_s), 1.0, m);
    EXPECT_NEAR(process / walk, 1.0, 2.0 * static_cast<double>(m) / correlation_time_s) << m;
  }
}

TEST(NoiseModel, SecondDifferencesHaveTheAllanVariance) {
  const NoiseModel models[] = {{1.5, 0, 0, 0, 0, 0}, {0, 1.5, 0, 0, 0, 0},   {0, 0, 1.5, 0, 0, 0},
                               {0, 0, 0, 1.5, 0, 0}, {0, 0, 0, 0, 1.5, 3.0}, {1.0, 0.2, 0.3, 0.1, 0.7, 50.0}};
  const double dt_s = 0.25;
  for (const NoiseModel& model : models) {
    for (const std::int64_t m : {1, 2, 5, 64}) {
      const double tau_s = dt_s * static_cast<double>(m);
      const double expected = 2.0 * tau_s * tau_s * allan_variance(model, dt_s, m);
      EXPECT_NEAR(second_difference_covariance(model, dt_s, m, 0), expected, 1e-9 * expected) << m;
    }
  }
}

}  // namespace noise_model_test
}  // namespace inslab::allan
