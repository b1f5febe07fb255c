#include "inslab/noise/allan/goodness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/noise/allan/fit.hpp"
#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace goodness_test {

Likelihood simulated(const NoiseModel& model, std::uint64_t seed, std::size_t count) {
  Record record(0.1);
  test::SimulatedNoise noise(model, 0.1, seed);
  for (std::size_t k = 0; k < count; ++k) record.add(noise.next());
  return Likelihood(record);
}

TEST(Goodness, OfTheRightModelIsChiSquare) {
  // 200 records: the mean of chi-square over its degrees has a standard error of sqrt(2/degrees/200) = 2.7 % at 14
  // degrees; that the points are nearly independent may cost as much again. Below 1 % are 2 of 200; 9 with 1e-4.
  const NoiseModel truth{0.1, 0.0, 0.0, 0.01, 0.3, 3.0};
  double ratio = 0.0;
  int seldom = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Goodness goodness = goodness_of(simulated(truth, seed, 100'000), truth, 0);
    EXPECT_GE(goodness.degrees, 13);
    ratio += goodness.chi_square / goodness.degrees / 200.0;
    seldom += goodness.probability < 0.01 ? 1 : 0;
  }
  EXPECT_NEAR(ratio, 1.0, 0.15);
  EXPECT_LE(seldom, 9);
}

TEST(Goodness, AMissingTermIsPoorAndSaysWhere) {
  const Likelihood record = simulated({0.1, 0.0, 0.0, 0.0, 0.3, 10.0}, 5, 60'000);
  const Goodness goodness = goodness_of(record, fit(record, {Term::White}).model, 1);
  EXPECT_TRUE(goodness.is_poor());
  EXPECT_THAT(goodness.sentence(), ::testing::HasSubstr("the fit is poor: at tau "));
  EXPECT_THAT(goodness.sentence(), ::testing::HasSubstr("below the measured deviation"));
  const Goodness right = goodness_of(record, fit(record, {Term::White, Term::GaussMarkov}).model, 3);
  EXPECT_FALSE(right.is_poor());
  EXPECT_EQ(right.sentence(), "the fit explains the curve");
}

TEST(Goodness, WhatChanceDeniesButIsSlightIsSaidAndNotPoor) {
  const Likelihood record = simulated({0.1, 0.0, 0.0, 0.0, 0.0, 0.0}, 6, 400'000);
  NoiseModel near;
  near.white = 0.1 * 1.02;
  const Goodness goodness = goodness_of(record, near, 0);
  EXPECT_LT(goodness.probability, 1e-3);
  EXPECT_FALSE(goodness.is_poor());
  EXPECT_THAT(goodness.sentence(), ::testing::HasSubstr("departs from the curve a little"));
}

TEST(Goodness, OfAHandfulOfSamplesIsNotJudged) {
  const Likelihood record = simulated({0.1, 0.0, 0.0, 0.0, 0.0, 0.0}, 7, 8);
  EXPECT_EQ(goodness_of(record, {0.1, 0.0, 0.0, 0.0, 0.0, 0.0}, 1).sentence(), "too few points to judge the fit");
}

}  // namespace goodness_test
}  // namespace inslab::allan
