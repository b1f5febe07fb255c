#include "inslab/nav/compensated_sum.hpp"

#include <gtest/gtest.h>

namespace inslab::nav {
namespace compensated_sum_test {

TEST(CompensatedSum, KeepsWhatPlainAdditionLoses) {
  // A million terms of 0.1 beside 1e9, whose unit in the last place is 1.2e-7: plainly each addition errs by up to
  // 6e-8. Here the sum errs by 2e-16 of the terms' 1e5, 2e-11, and is rounded once.
  double plain = 1e9;
  CompensatedSum sum(1e9);
  for (int i = 0; i < 1000000; ++i) {
    plain += 0.1;
    sum.add(0.1);
  }
  EXPECT_GT(plain - 1e9 - 1e5, 1e-4);
  EXPECT_NEAR((sum.value() - 1e9 - 1e5) + sum.rest(), 0.0, 2e-11);
}

TEST(CompensatedSum, RestIsBelowHalfAUnitInTheLastPlace) {
  CompensatedSum sum(1.0);
  sum.add(1e-17);
  EXPECT_EQ(sum.value(), 1.0);
  EXPECT_EQ(sum.rest(), 1e-17);
  for (int i = 0; i < 10; ++i) sum.add(1e-17);
  EXPECT_LE(sum.rest(), 1.2e-16);
}

}  // namespace compensated_sum_test
}  // namespace inslab::nav
