#include "inslab/noise/allan/confidence.hpp"

#include <gtest/gtest.h>

#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace confidence_test {

TEST(Confidence, QuantilesOfChiSquareAreThoseOfTheTables) {
  // Abramowitz and Stegun, table 26.8.
  EXPECT_NEAR(chi_square_quantile(0.99, 1.0), 6.63490, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.95, 10.0), 18.3070, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.005, 30.0), 13.7867, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.5, 2.0), 1.386294, 5e-7);
  // Above 2000 degrees another formula takes over; both meet there.
  EXPECT_NEAR(chi_square_quantile(0.995, 2000.1) - chi_square_quantile(0.995, 1999.9), 0.2, 0.02);
}

TEST(Confidence, DegreesOfFreedomOfWhiteNoiseAreThoseOfTheClosedForm) {
  // At m = 1 second differences are differences of neighbouring increments: rho_1 = -1/2, edf = M/(1 + 2/4).
  NoiseModel white;
  white.white = 1.0;
  const double terms = 1e6;
  EXPECT_NEAR(equivalent_degrees_of_freedom({1, 1.0, 1, 1'000'000}, white, 1.0) / terms, 1.0 / 1.5, 1e-6);
}

TEST(Confidence, StepsOverManyLagsChangeTheDegreesOfFreedomByLessThanAThousandth) {
  // Against every lag of the definition, at 640 samples a cluster: steps of ten lags.
  const NoiseModel models[] = {{1.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                               {0.0, 0.0, 0.0, 1.0, 0.0, 0.0},
                               {0.01, 30.0, 0.0, 0.0, 0.0, 0.0},
                               {1.0, 0.0, 1.0, 0.0, 1.0, 300.0}};
  const AllanPoint point{640, 1.0, 1, 20'000};
  for (const NoiseModel& model : models) {
    const double variance = second_difference_covariance(model, 1.0, point.m, 0);
    double correlated = 0.0;
    for (std::int64_t i = 1; i < point.terms; ++i) {
      const double rho = second_difference_covariance(model, 1.0, point.m, i) / variance;
      correlated += (1.0 - static_cast<double>(i) / 20'000.0) * rho * rho;
    }
    const double expected = 20'000.0 / (1.0 + 2.0 * correlated);
    EXPECT_NEAR(equivalent_degrees_of_freedom(point, model, 1.0), expected, 1e-3 * expected);
  }
}

TEST(Confidence, EstimatesScatterAsTheirDegreesOfFreedomSay) {
  // 400 records: the sample variance of the estimates has relative standard error sqrt(2/400) = 7 % and, chi-square
  // with about 15 degrees being heavier in its tail than normal, sqrt((2 + 12/15)/400) = 8.4 %; four of them.
  const NoiseModel model{1.0, 0.0, 0.0, 0.0, 0.8, 30.0};
  double sum = 0.0, squares = 0.0;
  AllanPoint point;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const auto phase = test::integrated(test::simulated_increments(model, 1.0, seed, 400));
    point = overlapped_allan_variance(phase, 1.0, 20);
    sum += point.variance;
    squares += point.variance * point.variance;
  }
  const double mean = sum / 400.0;
  const double variance = squares / 400.0 - mean * mean;
  const double degrees = equivalent_degrees_of_freedom(point, model, 1.0);
  EXPECT_NEAR(2.0 * mean * mean / variance / degrees, 1.0, 4.0 * 0.084);
  EXPECT_NEAR(mean / allan_variance(model, 1.0, 20), 1.0, 4.0 * std::sqrt(2.0 / degrees / 400.0));
}

TEST(Confidence, IntervalsHoldTheTruthAsOftenAsTheySay) {
  // 1000 intervals at 90 %: 900 +- 4 sqrt(1000 * 0.9 * 0.1).
  NoiseModel white;
  white.white = 1.0;
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const auto phase = test::integrated(test::simulated_increments(white, 1.0, seed, 200));
    const AllanPoint point = overlapped_allan_variance(phase, 1.0, 5);
    const double degrees = equivalent_degrees_of_freedom(point, white, 1.0);
    held += variance_interval(point.variance, degrees, 0.9).contains(allan_variance(white, 1.0, 5)) ? 1 : 0;
  }
  EXPECT_NEAR(held, 900, 4.0 * std::sqrt(90.0));
}

TEST(Confidence, QuantilesOfNothingAreRefused) {
  EXPECT_THROW(chi_square_quantile(1.0, 3.0), std::invalid_argument);
  EXPECT_THROW(chi_square_quantile(0.5, 0.0), std::invalid_argument);
}

}  // namespace confidence_test
}  // namespace inslab::allan
