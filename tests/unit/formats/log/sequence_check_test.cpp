#include "inslab/formats/log/sequence_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace inslab::log {
namespace sequence_check_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

SequenceCheck checked(std::initializer_list<std::uint64_t> numbers) {
  SequenceCheck check;
  for (const std::uint64_t number : numbers) check.add(number, static_cast<std::int64_t>(10 * number));
  return check;
}

TEST(SequenceCheck, FindsNothingInAWholeStream) {
  const SequenceCheck check = checked({0, 1, 2, 3});
  EXPECT_THAT(check.gaps(), IsEmpty());
  EXPECT_EQ(check.missing(), 0u);
  EXPECT_EQ(check.duplicates(), 0u);
  EXPECT_EQ(check.out_of_order(), 0u);
}

TEST(SequenceCheck, SaysWhereNumbersAreMissing) {
  const SequenceCheck check = checked({0, 1, 4, 5, 9});
  EXPECT_THAT(check.gaps(), ElementsAre(SequenceGap{2, 3, 10}, SequenceGap{6, 8, 50}));
  EXPECT_EQ(check.missing(), 5u);
}

TEST(SequenceCheck, AStreamThatBeginsLateMissesItsBeginning) {
  EXPECT_THAT(checked({3, 4}).gaps(), ElementsAre(SequenceGap{0, 2, 0}));
}

TEST(SequenceCheck, ALateSampleFillsItsGapAndIsOutOfOrder) {
  const SequenceCheck check = checked({0, 5, 3, 1});
  EXPECT_THAT(check.gaps(), ElementsAre(SequenceGap{2, 2, 0}, SequenceGap{4, 4, 0}));
  EXPECT_EQ(check.out_of_order(), 2u);
  EXPECT_EQ(check.duplicates(), 0u);
}

TEST(SequenceCheck, ARepeatedNumberIsADuplicate) {
  const SequenceCheck check = checked({0, 1, 1, 0, 2});
  EXPECT_EQ(check.duplicates(), 2u);
  EXPECT_EQ(check.out_of_order(), 0u);
  EXPECT_THAT(check.gaps(), IsEmpty());
}

}  // namespace sequence_check_test
}  // namespace inslab::log
