#include "inslab/nav/rotation_rate.hpp"

#include <gtest/gtest.h>

#include "inslab/nav/attitude.hpp"

namespace inslab::nav {
namespace rotation_rate_test {

TEST(RotationRate, IsTheDerivativeOfTheAttitude) {
  // q(Phi(t)) with Phi linear, seen half a millisecond before and after: central differences err by Phi'^3 dt^2/24 =
  // 1e-6, divided by the 2nd order of 1e-3 s steps: 27 * 1e-6/24.
  const Vector3 rate(1.0, -2.0, 1.5);
  constexpr double kStep_s = 1e-3;
  for (const double size : {0.0, 1e-6, 9e-3, 1.1e-2, 0.7, 3.0, 5.0}) {
    const Vector3 Phi = size * Vector3(2.0, 1.0, -2.0) / 3.0;
    const Quaternion before = quaternion_from_rotation_vector(Phi - 0.5 * kStep_s * rate);
    const Quaternion after = quaternion_from_rotation_vector(Phi + 0.5 * kStep_s * rate);
    const Vector3 turned = rotation_vector_from_quaternion(before.conjugate() * after) / kStep_s;
    EXPECT_LT((rate_from_rotation_vector(Phi, rate) - turned).norm(), 27e-6 / 24.0) << size;
  }
}

TEST(RotationRate, IsUndoneByItsInverse) {
  const Vector3 rate(0.3, -0.2, 0.9);
  for (const double size : {0.0, 1e-9, 1e-6, 9e-3, 1.1e-2, 0.7, 3.0, 3.14159, 5.0}) {
    const Vector3 Phi = size * Vector3(2.0, 1.0, -2.0) / 3.0;
    EXPECT_LT((rotation_vector_rate(Phi, rate_from_rotation_vector(Phi, rate)) - rate).norm(), 1e-14) << size;
  }
}

TEST(RotationRate, SeriesMeetsTheClosedForm) {
  // Either side of where one takes over from the other the values differ by the rate's own change.
  const Vector3 rate(0.3, -0.2, 0.9), axis = Vector3(2.0, 1.0, -2.0) / 3.0;
  const Vector3 below = (1e-2 - 1e-12) * axis, above = (1e-2 + 1e-12) * axis;
  EXPECT_LT((rate_from_rotation_vector(below, rate) - rate_from_rotation_vector(above, rate)).norm(), 3e-12);
  EXPECT_LT((rotation_vector_rate(below, rate) - rotation_vector_rate(above, rate)).norm(), 3e-12);
}

}  // namespace rotation_rate_test
}  // namespace inslab::nav
