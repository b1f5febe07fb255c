#include <gtest/gtest.h>

#include "inslab/referee/verify/estimates.hpp"
#include "inslab/referee/verify/gnss.hpp"

/// `inslab verify gnss` with fewer seeds, and the statistics it rests on.
namespace inslab::verify {
namespace verify_gnss_test {

TEST(VerifyGnss, WhiteErrorsOfEveryGradeHaveTheirSigma) {
  const Table table = gnss_noise(3);
  EXPECT_EQ(table.rows.size(), 7U);
  EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(VerifyGnss, GaussMarkovErrorsHaveTheirSigmaAndCorrelationTime) {
  const Table table = gnss_gauss_markov(3);
  EXPECT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(VerifyGnss, LeverArmHoldsInAnyAttitude) {
  const Table table = gnss_lever_arm();
  EXPECT_EQ(table.rows.size(), 2U);
  EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(Estimates, HaveTheMeanAndTheStandardErrorOfTheirSpread) {
  Estimates estimates;
  for (const double value : {1.0, 2.0, 3.0, 4.0}) estimates.add(value);
  EXPECT_DOUBLE_EQ(estimates.mean(), 2.5);
  EXPECT_DOUBLE_EQ(estimates.standard_error(), std::sqrt(5.0 / 3.0 / 4.0));
}

}  // namespace verify_gnss_test
}  // namespace inslab::verify
