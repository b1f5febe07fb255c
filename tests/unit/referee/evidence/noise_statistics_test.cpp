#include "inslab/referee/evidence/noise_statistics.hpp"

#include <gtest/gtest.h>

#include "inslab/referee/evidence/residual_statistics.hpp"

namespace inslab::evidence {
namespace noise_statistics_test {

const Vector3 kX(1.0, 0.0, 0.0);
const Vector3 kAll(1.0, 1.0, 1.0);

TEST(NoiseStatistics, OfAFewValuesAreTheTextbooks) {
  NoiseStatistics series;
  // 1, 3, 8: mean 4; differences 2, 5: rms sqrt(29/2), over sqrt(2).
  for (const double x : {1.0, 3.0, 8.0}) series.add(series.count(), Vector3(x, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(series.mean().x(), 4.0);
  EXPECT_DOUBLE_EQ(series.pooled_white_sigma(kX), std::sqrt(29.0 / 4.0));
  EXPECT_DOUBLE_EQ(series.pooled_white_sigma(kAll), std::sqrt(29.0 / 12.0));
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
  EXPECT_DOUBLE_EQ(series.mean().x(), 1e9 + 0.5);
}

TEST(ResidualStatistics, LeaveWhatMotionAndDriftDoNotExplain) {
  ResidualStatistics series;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const double t = 0.005 * i;
    const Vector3 omega(0.1 * std::sin(t), 0.02 * std::cos(0.7 * t), 0.3 * std::sin(0.3 * t));
    const Vector3 f(std::sin(0.5 * t), 0.5 * std::cos(t), -9.8);
    const Vector3 explained = Vector3(5.0, -2.0, 1.0) + 0.1 * t * Vector3::Ones() + 0.02 * omega +
                              0.01 * omega.y() * kX + 0.003 * f.x() * kAll;
    series.add(t, explained + (i % 2 == 0 ? 1e-4 : -1e-4) * kAll, omega, f);
  }
  // One of the eight regressors never changes beside the constant: seven degrees of freedom are used.
  EXPECT_NEAR(series.pooled_sigma(), 1e-4 * std::sqrt(kCount / (kCount - 7.0)), 1e-8);
}

TEST(ResidualStatistics, ARateThatFollowsAnotherExplainsNothingMore) {
  ResidualStatistics one, both;
  for (int i = 0; i < 12; ++i) {
    const double rate = 0.1 * std::sin(0.9 * i);
    const Vector3 error = (1e-4 * ((i * 7) % 5) + 0.02 * rate) * kAll;
    one.add(i, error, rate * kX, kX);
    both.add(i, error, Vector3(rate, rate / 3.0, 0.7 * rate), kX);
  }
  EXPECT_NEAR(both.pooled_sigma(), one.pooled_sigma(), 1e-9 * one.pooled_sigma());
}

TEST(ResidualStatistics, OfASensorAtRestAreTheSpreadAboutALine) {
  ResidualStatistics series;
  for (int i = 0; i < 1000; ++i) series.add(i, Vector3::Constant(3.0 + 2.0 * i + (i % 2)), Vector3::Zero(), kX);
  EXPECT_NEAR(series.pooled_sigma(), 0.5, 1e-3);
}

}  // namespace noise_statistics_test
}  // namespace inslab::evidence
