#include "inslab/models/navigation/refusals.hpp"

#include <gtest/gtest.h>

namespace inslab::navigation {
namespace refusals_test {

TEST(Refusals, AreSaidOnceWhateverTheirNumbers) {
  Refusals refusals;
  EXPECT_FALSE(refusals.note(""));
  EXPECT_TRUE(refusals.note("the force spreads by 0.061 m/s^2"));
  EXPECT_FALSE(refusals.note("the force spreads by 0.061 m/s^2"));
  EXPECT_TRUE(refusals.note("the receiver says that it moves"));
  EXPECT_FALSE(refusals.note("the force spreads by 1.2e-01 m/s^2"));
  EXPECT_EQ(refusals.words(), "the force spreads by 0.061 m/s^2; the receiver says that it moves");
}

}  // namespace refusals_test
}  // namespace inslab::navigation
