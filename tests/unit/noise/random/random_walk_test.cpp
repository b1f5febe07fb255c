#include "inslab/noise/random/random_walk.hpp"

#include <gtest/gtest.h>

#include <string>

namespace inslab::random {
namespace random_walk_test {

constexpr double kDensity = 3.0;

TEST(RandomWalk, BeginsAtZeroAndStepsByTheNumbersOfItsStream) {
  const Stream stream(11, "walk");
  RandomWalk walk(kDensity, 0.25, stream);
  EXPECT_EQ(walk.value(), 0.0);
  double sum = 0.0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    walk.advance(k);
    sum += 0.5 * stream.normal(k);
    EXPECT_DOUBLE_EQ(walk.value(), kDensity * sum);
  }
}

TEST(RandomWalk, VarianceGrowsWithTime) {
  // 4000 walks: the sample variance has the relative standard error sqrt(2/4000) = 2.2 %.
  double squares = 0.0;
  for (int i = 0; i < 4000; ++i) {
    RandomWalk walk(kDensity, 0.1, Stream(11, "walk" + std::to_string(i)));
    for (std::uint64_t k = 0; k < 50; ++k) walk.advance(k);
    squares += walk.value() * walk.value();
  }
  const double expected = kDensity * kDensity * 5.0;
  EXPECT_NEAR(squares / 4000.0, expected, 4.0 * 0.022 * expected);
}

TEST(RandomWalk, RetuneDoesNotJumpInUnitsOfItsDensityAndResetBeginsAgain) {
  RandomWalk walk(kDensity, 0.1, Stream(11, "walk"));
  for (std::uint64_t k = 0; k < 10; ++k) walk.advance(k);
  const double before = walk.value();
  walk.retune(2.0 * kDensity);
  EXPECT_DOUBLE_EQ(walk.value(), 2.0 * before);
  walk.reset();
  EXPECT_EQ(walk.value(), 0.0);
}

TEST(RandomWalk, RefusesWhatCannotBe) {
  const Stream stream(11, "walk");
  EXPECT_THROW(RandomWalk(-1.0, 0.1, stream), std::invalid_argument);
  EXPECT_THROW(RandomWalk(1.0, 0.0, stream), std::invalid_argument);
}

}  // namespace random_walk_test
}  // namespace inslab::random
