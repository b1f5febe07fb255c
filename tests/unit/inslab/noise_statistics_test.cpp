#include "services/inslab/noise_statistics.hpp"

#include <gtest/gtest.h>

namespace inslab::cli {
namespace {

const Vector3 kX(1.0, 0.0, 0.0);
const Vector3 kAll(1.0, 1.0, 1.0);

TEST(NoiseStatistics, OfAFewValuesAreTheTextbooks) {
  NoiseStatistics series;
  // 1, 3, 8: mean 4, variance ((9 + 1 + 16)/2) = 13; differences 2, 5: rms sqrt(29/2), over sqrt(2).
  for (const double x : {1.0, 3.0, 8.0}) series.add(series.count(), Vector3(x, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(series.mean().x(), 4.0);
  EXPECT_DOUBLE_EQ(series.pooled_sigma(kX), std::sqrt(13.0));
  EXPECT_DOUBLE_EQ(series.pooled_white_sigma(kX), std::sqrt(29.0 / 4.0));
  EXPECT_DOUBLE_EQ(series.pooled_sigma(kAll), std::sqrt(13.0 / 3.0));
}

TEST(NoiseStatistics, TakeDifferencesBetweenNeighboursOnly) {
  NoiseStatistics series;
  series.add(0, Vector3::Zero());
  series.add(1, Vector3::Constant(1.0));
  series.add(5, Vector3::Constant(100.0));
  series.add(6, Vector3::Constant(101.0));
  EXPECT_EQ(series.count(), 4U);
  EXPECT_EQ(series.differences(), 2U);
  EXPECT_DOUBLE_EQ(series.pooled_white_sigma(kAll), std::sqrt(0.5));
}

TEST(NoiseStatistics, AreExactBesideALargeMean) {
  NoiseStatistics series;
  for (int i = 0; i < 1000; ++i) series.add(series.count(), Vector3(1e9 + (i % 2), 0.0, 0.0));
  // Half zeros, half ones: variance 1/4 n/(n-1).
  EXPECT_NEAR(series.pooled_sigma(kX), 0.5 * std::sqrt(1000.0 / 999.0), 1e-9);
  EXPECT_DOUBLE_EQ(series.mean().x(), 1e9 + 0.5);
}

}  // namespace
}  // namespace inslab::cli
