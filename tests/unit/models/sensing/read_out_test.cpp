#include "inslab/models/sensing/read_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::sensing {
namespace {

TEST(ReadOut, ValuesAreShownInTheNearestWholeCounts) {
  EXPECT_DOUBLE_EQ(quantized(10.3, 0.25), 10.25);
  EXPECT_DOUBLE_EQ(quantized(-10.4, 0.25), -10.5);
  EXPECT_EQ(quantized(Vector3(10.3, -10.4, 7.77), Vector3(0.25, 0.25, 0.0)), Vector3(10.25, -10.5, 7.77));
}

TEST(ReadOut, ACountOfZeroLeavesTheValueAsItIs) { EXPECT_EQ(quantized(1.0 / 3.0, 0.0), 1.0 / 3.0); }

TEST(ReadOut, OnlyValuesBeyondAnEndAreCutThere) {
  double value = 3.0;
  EXPECT_FALSE(cut(value, 1.0, 3.0));
  EXPECT_EQ(value, 3.0);
  value = 3.5;
  EXPECT_TRUE(cut(value, 1.0, 3.0));
  EXPECT_EQ(value, 3.0);
  value = 0.5;
  EXPECT_TRUE(cut(value, 1.0, HUGE_VAL));
  EXPECT_EQ(value, 1.0);
}

TEST(ReadOut, EachAxisHasItsFullScaleAndZeroIsNone) {
  Vector3 value(7.0, -7.0, 1e9);
  EXPECT_TRUE(cut(value, Vector3(8.0, 5.0, 0.0)));
  EXPECT_EQ(value, Vector3(7.0, -5.0, 1e9));
  EXPECT_FALSE(cut(value, Vector3(8.0, 5.0, 0.0)));
}

}  // namespace
}  // namespace inslab::sensing
