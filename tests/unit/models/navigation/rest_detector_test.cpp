#include "inslab/models/navigation/rest_detector.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "inslab/foundation/units/units.hpp"

namespace inslab::navigation {
namespace rest_detector_test {

constexpr double kDt_s = 0.005;
const Vector3 kGravity(0.0, 0.0, -9.8);

/// Windows of rest found in 10 s of these rates and forces.
int windows(const std::function<Vector3(int)>& omega, const std::function<Vector3(int)>& f) {
  RestDetector detector{ZeroVelocity{}};
  int found = 0;
  for (int k = 0; k < 2000; ++k) found += detector.add(omega(k), f(k), kDt_s) ? 1 : 0;
  return found;
}

Vector3 still(int) { return Vector3::Zero(); }
Vector3 gravity(int) { return kGravity; }

TEST(RestDetector, FindsEveryWindowOfRest) { EXPECT_EQ(windows(still, gravity), 10); }

TEST(RestDetector, ShakingBeyondTheThresholdIsMotion) {
  // +-a has the standard deviation a; the threshold is 0.05 m/s^2.
  const auto shaken = [](double a) {
    return [a](int k) { return Vector3(kGravity + Vector3(k % 2 == 0 ? a : -a, 0.0, 0.0)); };
  };
  EXPECT_EQ(windows(still, shaken(0.049)), 10);
  EXPECT_EQ(windows(still, shaken(0.051)), 0);
}

TEST(RestDetector, ASteadyTurnIsMotion) {
  EXPECT_EQ(windows([](int) { return Vector3(0.0, 0.0, 0.6 * units::kDegPerS); }, gravity), 0);
}

TEST(RestDetector, RockingIsMotion) {
  EXPECT_EQ(windows([](int k) { return Vector3(units::kDegPerS * (k % 2 == 0 ? 0.4 : -0.4), 0.0, 0.0); }, gravity), 0);
}

}  // namespace rest_detector_test
}  // namespace inslab::navigation
