#include "inslab/models/imu/noise.hpp"

#include <gtest/gtest.h>

namespace inslab::imu {
namespace noise_test {

constexpr double kDt = 0.005;

TriadParameters white(double density) {
  TriadParameters parameters;
  parameters.random_walk.setConstant(density);
  return parameters;
}

TEST(Noise, IsTheWhiteNoiseOfItsStream) {
  Noise noise(white(2.0), kDt, 77, "imu0/accel", "vrw");
  random::WhiteNoise expected(2.0, kDt, random::Stream(77, "imu0/accel.x/vrw"));
  for (std::uint64_t k = 0; k < 20; ++k) EXPECT_EQ(noise.error(k).x(), expected.increment(k));
}

TEST(Noise, ABurstAddsNoiseOfItsOwnAndLeavesAgain) {
  Noise noise(white(2.0), kDt, 77, "imu0/gyro", "arw"), quiet = noise;
  noise.set_burst({0.0, 5.0, 0.0});
  const Vector3 difference = noise.error(3) - quiet.error(3);
  EXPECT_EQ(difference.x(), 0.0);
  random::WhiteNoise burst(5.0, kDt, random::Stream(77, "imu0/gyro.y/burst"));
  EXPECT_NEAR(difference.y(), burst.increment(3), 1e-15);  // rounding of a difference of numbers of 1
  noise.set_burst(Vector3::Zero());
  EXPECT_EQ(noise.error(4), quiet.error(4));
}

}  // namespace noise_test
}  // namespace inslab::imu
