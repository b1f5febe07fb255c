#include "inslab/noise/random/random_constant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace inslab::random {
namespace random_constant_test {

TEST(RandomConstant, ItsSpreadOverManySensorsIsSigma) {
  // The sample variance of 4000 draws has relative standard error sqrt(2/4000) = 2.2 %.
  double sum = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double value = RandomConstant(5.0, Stream(3, "imu" + std::to_string(i))).value();
    sum += value * value;
  }
  EXPECT_NEAR(sum / 4000, 25.0, 4 * 0.0224 * 25.0);
}

TEST(RandomConstant, StaysUntilItIsRedrawnAndScalesWithSigma) {
  RandomConstant constant(2.0, Stream(3, "imu0"));
  const double value = constant.value();
  constant.retune(6.0);
  EXPECT_DOUBLE_EQ(constant.value(), 3.0 * value);
  constant.redraw(17);
  EXPECT_NE(constant.value(), 3.0 * value);
}

TEST(RandomConstant, RefusesANegativeSigma) {
  EXPECT_THROW(RandomConstant(-1.0, Stream(3, "imu0")), std::invalid_argument);
}

}  // namespace random_constant_test
}  // namespace inslab::random
