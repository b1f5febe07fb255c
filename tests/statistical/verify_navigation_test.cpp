#include <gtest/gtest.h>

#include "services/inslab/verify/navigation.hpp"

namespace inslab::verify {
namespace {

TEST(VerifyNavigation, TheFilterThatMatchesTheImuKnowsHowWrongItIs) {
  const Table table = honesty_table(100);
  EXPECT_TRUE(table.held()) << to_text(table);
}

}  // namespace
}  // namespace inslab::verify
