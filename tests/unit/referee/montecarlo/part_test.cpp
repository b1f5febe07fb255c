#include "inslab/referee/montecarlo/part.hpp"

#include <gtest/gtest.h>

namespace inslab::montecarlo {
namespace part_test {

TEST(PartOfAStudy, IsAllOfItWhenNoneIsNamed) {
  EXPECT_EQ(part_of("", 10)->first, 0u);
  EXPECT_EQ(part_of("", 10)->end, 10u);
}

TEST(PartOfAStudy, AllPartsTogetherAreEveryRunOnce) {
  std::uint32_t next = 0;
  for (int k = 1; k <= 7; ++k) {
    const auto part = part_of(std::to_string(k) + "/7", 100);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->first, next);
    next = part->end;
  }
  EXPECT_EQ(next, 100u);
}

TEST(PartOfAStudy, IsNoOtherText) {
  for (const char* text : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "-1/3", " 1/3", "1/ 3", "x"}) {
    EXPECT_FALSE(part_of(text, 10)) << text;
  }
}

}  // namespace part_test
}  // namespace inslab::montecarlo
