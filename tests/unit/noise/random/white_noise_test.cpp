#include "inslab/noise/random/white_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace inslab::random {
namespace white_noise_test {

constexpr std::uint64_t kSeed = 5;

TEST(WhiteNoise, IncrementsHaveTheDensityTimesTheRootOfTheInterval) {
  // The sample variance of N draws has relative standard error sqrt(2/N) = 0.45 %.
  constexpr std::uint64_t kCount = 100000;
  WhiteNoise noise(0.3, 0.005, Stream(kSeed, "arw"));
  double sum = 0.0;
  for (std::uint64_t k = 0; k < kCount; ++k) {
    const double w = noise.increment(k);
    sum += w * w;
  }
  const double expected = 0.3 * 0.3 * 0.005;
  EXPECT_NEAR(sum / kCount, expected, 4.0 * std::sqrt(2.0 / kCount) * expected);
}

TEST(WhiteNoise, ARandomWalkGrowsWithTheRootOfTimeAtAnyRate) {
  // 2000 walks of 1 s at 10 and at 100 Hz end with the variance N^2 * 1 s; relative standard error sqrt(2/2000) = 3.2
  // %.
  for (const std::uint64_t rate : {10ULL, 100ULL}) {
    double sum = 0.0;
    for (int walk = 0; walk < 2000; ++walk) {
      WhiteNoise noise(2.0, 1.0 / static_cast<double>(rate), Stream(kSeed, "walk" + std::to_string(walk)));
      double angle = 0.0;
      for (std::uint64_t k = 0; k < rate; ++k) angle += noise.increment(k);
      sum += angle * angle;
    }
    EXPECT_NEAR(sum / 2000, 4.0, 4.0 * 0.032 * 4.0) << rate << " Hz";
  }
}

TEST(WhiteNoise, RetuneScalesTheSameDraws) {
  WhiteNoise noise(1.0, 0.01, Stream(kSeed, "arw"));
  const double before = noise.increment(41);
  noise.retune(2.0);
  EXPECT_DOUBLE_EQ(noise.increment(41), 2.0 * before);
  noise.retune(0.0);
  EXPECT_EQ(noise.increment(41), 0.0);
}

TEST(WhiteNoise, RefusesWhatHasNoMeaning) {
  const Stream stream(kSeed, "arw");
  EXPECT_THROW(WhiteNoise(-1.0, 0.01, stream), std::invalid_argument);
  EXPECT_THROW(WhiteNoise(1.0, 0.0, stream), std::invalid_argument);
  EXPECT_THROW(WhiteNoise(std::numeric_limits<double>::quiet_NaN(), 0.01, stream), std::invalid_argument);
}

}  // namespace white_noise_test
}  // namespace inslab::random
