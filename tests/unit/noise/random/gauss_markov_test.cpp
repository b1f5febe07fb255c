#include "inslab/noise/random/gauss_markov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace inslab::random {
namespace gauss_markov_test {

constexpr std::uint64_t kSeed = 11;
constexpr double kSigma = 3.0;
constexpr int kStreams = 4000;

/// Mean of x[first] * x[second] over independent processes.
double ensemble_product(const GaussMarkov::Parameters& parameters, double dt_s, std::uint64_t first,
                        std::uint64_t second) {
  double sum = 0.0;
  for (int i = 0; i < kStreams; ++i) {
    GaussMarkov process(parameters, dt_s, Stream(kSeed, "gm" + std::to_string(i)));
    double at_first = process.value();
    for (std::uint64_t k = 0; k < second; ++k) {
      if (k == first) at_first = process.value();
      process.advance(k);
    }
    sum += (first == second ? process.value() : at_first) * process.value();
  }
  return sum / kStreams;
}

// 4000 independent streams: the sample variance of N draws has relative standard error sqrt(2/N) = 2.2 %.
TEST(GaussMarkov, VarianceIsSigmaSquaredFromTheFirstSample) {
  for (const std::uint64_t k : {0ULL, 1ULL, 10ULL, 200ULL}) {
    EXPECT_NEAR(ensemble_product({kSigma, 10.0}, 0.5, k, k), kSigma * kSigma, 4 * 0.0224 * kSigma * kSigma) << k;
  }
}

// The product of two jointly normal numbers of correlation r has the variance sigma^4 (1 + r^2).
TEST(GaussMarkov, AutocorrelationFallsByEAfterOneCorrelationTime) {
  const double r = std::exp(-1.0);
  const double bound = 4.0 * std::sqrt((1.0 + r * r) / kStreams) * kSigma * kSigma;
  EXPECT_NEAR(ensemble_product({kSigma, 10.0}, 0.5, 5, 25), r * kSigma * kSigma, bound);
  EXPECT_NEAR(ensemble_product({kSigma, 10.0}, 10.0, 5, 6), r * kSigma * kSigma, bound);
}

TEST(GaussMarkov, KeepsItsSpreadWhenTheCorrelationTimeIsBillionsOfIntervals) {
  // exp(-2 dt/T) rounds to 1 less a few units here; after n steps the state differs from the first by the variance
  // 2 sigma^2 (1 - exp(-n dt/T)) = 2 sigma^2 n dt/T; relative standard error sqrt(2/4000) = 2.2 %.
  constexpr double kDt = 1e-3, kT = 1e7;
  double sum = 0.0;
  for (int i = 0; i < kStreams; ++i) {
    GaussMarkov process({kSigma, kT}, kDt, Stream(kSeed, "long" + std::to_string(i)));
    const double start = process.value();
    for (std::uint64_t k = 0; k < 100; ++k) process.advance(k);
    sum += (process.value() - start) * (process.value() - start);
  }
  const double expected = 2.0 * kSigma * kSigma * 100 * kDt / kT;
  EXPECT_NEAR(sum / kStreams, expected, 4 * 0.0224 * expected);
}

TEST(GaussMarkov, TheDriveDependsOnStreamAndIndexAlone) {
  const Stream stream(kSeed, "gm");
  GaussMarkov a({1.0, 5.0}, 1.0, stream);
  a.advance(0);
  const double expected = std::exp(-0.2) * a.value() + std::sqrt(1.0 - std::exp(-0.4)) * stream.normal(2);
  EXPECT_NEAR(a.advance(1), expected, 1e-15);
}

TEST(GaussMarkov, RetuneDoesNotJumpInUnitsOfSigma) {
  GaussMarkov process({2.0, 50.0}, 0.1, Stream(kSeed, "gm"));
  for (std::uint64_t k = 0; k < 100; ++k) process.advance(k);
  const double before = process.value() / 2.0;
  process.retune({30.0, 7.0});
  EXPECT_DOUBLE_EQ(process.value() / 30.0, before);
  process.retune({0.0, 0.0});
  EXPECT_EQ(process.advance(100), 0.0);
  process.retune({2.0, 50.0});
  EXPECT_DOUBLE_EQ(process.value() / 2.0, before);
}

TEST(GaussMarkov, ResetStartsFromZeroAndRedrawFromTheSteadySpread) {
  GaussMarkov process({1.0, 100.0}, 1.0, Stream(kSeed, "gm"));
  process.reset();
  EXPECT_EQ(process.value(), 0.0);
  double sum = 0.0;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    process.redraw(k);
    sum += process.value() * process.value();
  }
  EXPECT_NEAR(sum / 4000, 1.0, 4 * 0.0224);  // as above
}

TEST(GaussMarkov, RefusesZeroCorrelationTime) {
  const Stream stream(kSeed, "gm");
  EXPECT_THROW(GaussMarkov({1.0, 0.0}, 0.01, stream), std::invalid_argument);
  EXPECT_THROW(GaussMarkov({-1.0, 1.0}, 0.01, stream), std::invalid_argument);
  EXPECT_THROW(GaussMarkov({1.0, 1.0}, 0.0, stream), std::invalid_argument);
  EXPECT_NO_THROW(GaussMarkov({0.0, 0.0}, 0.01, stream));
}

TEST(GaussMarkov, ARefusedRetuneChangesNothing) {
  GaussMarkov process({1.0, 10.0}, 0.1, Stream(kSeed, "gm"));
  const double before = process.value();
  EXPECT_THROW(process.retune({2.0, -1.0}), std::invalid_argument);
  EXPECT_EQ(process.value(), before);
}

}  // namespace gauss_markov_test
}  // namespace inslab::random
