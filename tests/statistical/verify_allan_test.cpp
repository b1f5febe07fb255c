#include <gtest/gtest.h>

#include <cmath>

#include "inslab/referee/verify/allan_block.hpp"

/// The code of `inslab verify allan`, on runs short enough for every day; its whole table is in docs/allan.md.
namespace inslab::verify {
namespace verify_allan_test {

void quiet(const std::string&) {}

bool all_held(const std::vector<Table>& tables) {
  bool held = true;
  for (const Table& table : tables) {
    held = held && table.held();
    if (!table.held()) ADD_FAILURE() << to_text(table);
  }
  return held;
}

TEST(VerifyAllan, TwentyMinutesOfWhiteNoiseHaveTheSetDensity) {
  EXPECT_TRUE(all_held(tables_of(verify_grade(thesis_grades().front(), {1, 2}, quiet))));
}

TEST(VerifyAllan, AGaussMarkovBiasHasTheSetSigmaAndCorrelationTime) {
  Grade grade = thesis_grades().back();  // T = 10 s
  grade.duration_s = 1800.0;
  EXPECT_TRUE(all_held(tables_of(verify_grade(grade, {1, 2}, quiet))));
}

TEST(VerifyAllan, StandardErrorsAreThoseOfSoManyCorrelationTimes) {
  // Asymptotically sqrt(2 T/D) of T and a quarter of that variance of sigma: Fisher's information of a sampled process.
  const Grade grade = thesis_grades().back();
  const std::vector<double> found = standard_errors_of_a_record(grade, true);
  const double of_time = std::sqrt(2.0 * grade.gyro.gm_time_s / grade.duration_s);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0], 0.5 * of_time, 1e-3 * of_time);
  EXPECT_NEAR(found[1], of_time, 1e-3 * of_time);
  EXPECT_DOUBLE_EQ(standard_errors_of_a_record(thesis_grades().front(), true).front(), 1.0 / std::sqrt(2.0 * 240000.0));
}

TEST(VerifyAllan, TheRecordsSpreadMayBeWhatChiSquareSays) {
  // Of 60 records the standard deviation is known to 1/sqrt(2 * 59) = 9.2 %.
  EXPECT_NEAR(allowed_spread(60).low, 1.0 - 3.5 * 0.092, 0.02);
  EXPECT_NEAR(allowed_spread(60).high, 1.0 + 3.5 * 0.092, 0.03);
  EXPECT_EQ(allowed_outside(1200), 24);
}

}  // namespace verify_allan_test
}  // namespace inslab::verify
