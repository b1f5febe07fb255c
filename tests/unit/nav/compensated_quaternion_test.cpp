#include "inslab/nav/compensated_quaternion.hpp"

#include <gtest/gtest.h>

#include "inslab/nav/attitude.hpp"

namespace inslab::nav {
namespace compensated_quaternion_test {

const Quaternion kStart = quaternion_from_rpy({0.4, -0.7, 2.0});
const Vector3 kTurn_rad(3e-6, -5e-6, 2e-6);
constexpr int kTurns = 500000;

TEST(CompensatedQuaternion, HalfAMillionTurnsOfItsSourceAreOneGreatTurn) {
  CompensatedQuaternion q(kStart);
  for (int i = 0; i < kTurns; ++i) q.turn_source(kTurn_rad);
  // 4 roundings of 1e-16 in the two quaternions compared, not half a million.
  EXPECT_LT(angle_between(q.value(), kStart * quaternion_from_rotation_vector(kTurns * kTurn_rad)), 1e-15);
}

TEST(CompensatedQuaternion, HalfAMillionTurnsOfItsTargetAreOneGreatTurn) {
  CompensatedQuaternion q(kStart);
  for (int i = 0; i < kTurns; ++i) q.turn_target(kTurn_rad);
  EXPECT_LT(angle_between(q.value(), quaternion_from_rotation_vector(kTurns * kTurn_rad) * kStart), 1e-15);
}

TEST(CompensatedQuaternion, KeepsItsNorm) {
  CompensatedQuaternion q(kStart);
  for (int i = 0; i < kTurns; ++i) q.turn_source({0.01, 0.02, -0.03});
  EXPECT_NEAR(q.value().norm(), 1.0, 4e-16);
}

TEST(CompensatedQuaternion, TurnsByLargeAnglesToo) {
  CompensatedQuaternion q(kStart);
  q.turn_source({1.0, -2.0, 0.5});
  EXPECT_LT(angle_between(q.value(), kStart * quaternion_from_rotation_vector({1.0, -2.0, 0.5})), 1e-15);
}

}  // namespace compensated_quaternion_test
}  // namespace inslab::nav
