#include <gtest/gtest.h>

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
  const Grade grade = thesis_grades().front();
  EXPECT_TRUE(all_held(tables_of(verify_grade(grade, grade, {1, 2}, quiet))));
}

TEST(VerifyAllan, AGaussMarkovBiasHasTheSetSigmaAndCorrelationTime) {
  Grade grade = thesis_grades().back();  // T = 10 s
  grade.duration_s = 1800.0;
  EXPECT_TRUE(all_held(tables_of(verify_grade(grade, grade, {1, 2}, quiet))));
}

TEST(VerifyAllan, AValueThatIsNotTheSetOneFails) {
  // 6 records of 240000 samples: standard error about 0.06 %.
  const Grade grade = thesis_grades()[1];
  Grade other = grade;
  other.gyro.white *= 1.02;
  const auto tables = tables_of(verify_grade(grade, other, {1, 2}, quiet));
  EXPECT_FALSE(tables[0].rows[0].held);
  EXPECT_TRUE(tables[0].rows[1].held) << to_text(tables[0]);
  EXPECT_FALSE(tables[1].held());
  EXPECT_FALSE(tables[2].held());
}

TEST(VerifyAllan, FewerRecordsMayBeFurtherOffAndSixtyAsTheRuleSays) {
  EXPECT_DOUBLE_EQ(allowed_standard_errors(60), 3.5);
  EXPECT_GT(allowed_standard_errors(9), 4.5);
  EXPECT_EQ(allowed_outside(1200), 24);
}

}  // namespace verify_allan_test
}  // namespace inslab::verify
