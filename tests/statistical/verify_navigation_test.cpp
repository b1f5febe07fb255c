#include "services/inslab/verify/navigation.hpp"

#include <gtest/gtest.h>

namespace inslab::verify {
namespace {

TEST(VerifyNavigation, TheFilterThatMatchesTheImuKnowsHowWrongItIs) {
  const Table table = honesty_table(100);
  EXPECT_TRUE(table.held()) << to_text(table);
}

}  // namespace
}  // namespace inslab::verify
