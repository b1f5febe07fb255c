#include "inslab/referee/verify/outage_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {
namespace outage_verdict_test {

OutageVerdict of_pos830(const DriftFigures& ratios) { return judged(ratios, Against::Simulated, "pos830"); }

TEST(OutageVerdict, HoldsWithinTheFactorEitherWay) {
  EXPECT_TRUE(of_pos830({0.5, 2.0, 1.0, 1.0, 1.0}).held);
  EXPECT_FALSE(of_pos830({1.0, 0.49, 1.0, 1.0, 1.0}).held);
  EXPECT_FALSE(of_pos830({1.0, 2.01, 1.0, 1.0, 1.0}).held);
  EXPECT_FALSE(judged({1.0, 1.51, 1.0, 1.0, 1.0}, Against::Measured, "pos830").held);
}

TEST(OutageVerdict, SaysWhatAFigureWouldHaveToBeMultipliedBy) {
  EXPECT_EQ(of_pos830({0.4, 4.0, 1.0, 1.0, 1.0}).misses, "horizontal x1.25, vertical x0.50 (not known)");
}

TEST(OutageVerdict, IsAKnownMissOnlyWhereEveryFigureOutsideIsOneAndOnItsSide) {
  EXPECT_TRUE(of_pos830({0.4, 1.0, 1.0, 1.0, 0.4}).known_miss);
  EXPECT_FALSE(of_pos830({0.4, 0.4, 1.0, 1.0, 1.0}).known_miss);  // the vertical is none
  EXPECT_FALSE(of_pos830({2.5, 1.0, 1.0, 1.0, 1.0}).known_miss);  // too large is none
  EXPECT_FALSE(of_pos830({0.2, 1.0, 1.0, 1.0, 1.0}).known_miss);  // 2.5 times is more than is known
  EXPECT_FALSE(judged({0.4, 1.0, 1.0, 1.0, 1.0}, Against::Simulated, "stim300").known_miss);
}

Table of_rows(std::vector<Row> rows) { return {"title", {"what"}, std::move(rows), {}}; }

TEST(Table, HoldsWithAKnownMissAndCountsIt) {
  const Table table = of_rows({{{"a"}, true}, {{"b"}, false, true}});
  EXPECT_TRUE(table.held());
  EXPECT_EQ(table.misses(), 1U);
  EXPECT_THAT(to_text(table), testing::AllOf(testing::HasSubstr("a     PASS"), testing::HasSubstr("b     MISS")));
}

TEST(Table, DoesNotHoldWithAnotherMissNorWithoutRows) {
  const Table table = of_rows({{{"a"}, true}, {{"b"}, false}});
  EXPECT_FALSE(table.held());
  EXPECT_EQ(table.misses(), 0U);
  EXPECT_THAT(to_text(table), testing::HasSubstr("b     FAIL"));
  EXPECT_FALSE(of_rows({}).held());
}

}  // namespace outage_verdict_test
}  // namespace inslab::verify
