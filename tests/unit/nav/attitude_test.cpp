#include "inslab/nav/attitude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"

namespace inslab::nav {
namespace attitude_test {

constexpr double kRounding = 4e-15;  // some ten roundings of numbers below pi

Quaternion random_quaternion(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  return canonical(Quaternion(normal(generator), normal(generator), normal(generator), normal(generator)));
}

TEST(Attitude, YawTurnsFromNorthToEast) {
  EXPECT_LT((matrix_from_rpy({0.0, 0.0, units::kPi / 2}) * Vector3::UnitX() - Vector3::UnitY()).norm(), kRounding);
}

TEST(Attitude, PitchLiftsTheNoseAndRollLowersTheRightSide) {
  EXPECT_NEAR((matrix_from_rpy({0.0, 0.1, 0.0}) * Vector3::UnitX()).z(), -std::sin(0.1), kRounding);
  EXPECT_NEAR((matrix_from_rpy({0.1, 0.0, 0.0}) * Vector3::UnitY()).z(), std::sin(0.1), kRounding);
}

TEST(Attitude, MatrixIsTheProductOfYawPitchRoll) {
  const Matrix3 product = (Eigen::AngleAxisd(2.0, Vector3::UnitZ()) * Eigen::AngleAxisd(-0.7, Vector3::UnitY()) *
                           Eigen::AngleAxisd(1.1, Vector3::UnitX()))
                              .toRotationMatrix();
  EXPECT_LT((matrix_from_rpy({1.1, -0.7, 2.0}) - product).norm(), kRounding);
}

TEST(Attitude, QuaternionAndMatrixAgree) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> angle(-7.0, 7.0);
  for (int i = 0; i < 1000; ++i) {
    const RollPitchYaw rpy{angle(generator), angle(generator), angle(generator)};
    EXPECT_LT((matrix_from_quaternion(quaternion_from_rpy(rpy)) - matrix_from_rpy(rpy)).norm(), kRounding);
  }
}

TEST(Attitude, QuaternionsAreCanonical) {
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> angle(-7.0, 7.0);
  for (int i = 0; i < 1000; ++i) {
    const Quaternion q = quaternion_from_rpy({angle(generator), angle(generator), angle(generator)});
    EXPECT_GE(q.w(), 0.0);
    EXPECT_NEAR(q.norm(), 1.0, kRounding);
  }
  EXPECT_GT(canonical(Quaternion(0.0, -1.0, 0.0, 0.0)).x(), 0.0);
  EXPECT_THROW(canonical(Quaternion(0.0, 0.0, 0.0, 0.0)), std::domain_error);
  EXPECT_THROW(canonical(Quaternion(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 1.0)), std::domain_error);
}

TEST(Attitude, AnglesComeBackFromQuaternionAndMatrix) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const RollPitchYaw rpy{3.14 * unit(generator), 1.5 * unit(generator), units::kPi + 3.14 * unit(generator)};
    const RollPitchYaw back = rpy_from_quaternion(quaternion_from_rpy(rpy));
    const double loose = kRounding / std::cos(rpy.pitch_rad);  // roll and yaw weaken with cos(pitch)
    EXPECT_NEAR(back.roll_rad, rpy.roll_rad, loose);
    EXPECT_NEAR(back.pitch_rad, rpy.pitch_rad, kRounding);
    EXPECT_NEAR(back.yaw_rad, rpy.yaw_rad, loose);
    const Quaternion q = quaternion_from_rpy(rpy);
    EXPECT_LT(angle_between(quaternion_from_matrix(matrix_from_rpy(rpy)), q), kRounding);
  }
}

TEST(Attitude, YawStaysInZeroToTwoPi) {
  EXPECT_NEAR(rpy_from_matrix(matrix_from_rpy({0.0, 0.0, -0.5})).yaw_rad, 2.0 * units::kPi - 0.5, kRounding);
  // A rounding error west of north is north, not 2 pi.
  EXPECT_EQ(rpy_from_matrix(matrix_from_rpy({0.0, 0.0, -1e-17})).yaw_rad, 0.0);
}

TEST(Attitude, InGimbalLockRollIsZeroAndTheRotationIsKept) {
  for (const double pitch : {units::kPi / 2, -units::kPi / 2}) {
    const Matrix3 C_nb = matrix_from_rpy({0.4, pitch, 1.0});
    const RollPitchYaw rpy = rpy_from_matrix(C_nb);
    EXPECT_EQ(rpy.roll_rad, 0.0);
    EXPECT_NEAR(rpy.pitch_rad, pitch, 1e-15);
    EXPECT_NEAR(rpy.yaw_rad, pitch > 0.0 ? 0.6 : 1.4, kRounding);
    EXPECT_LT((matrix_from_rpy(rpy) - C_nb).norm(), kRounding);
  }
}

TEST(Attitude, AnglesKeepTheRotationThroughGimbalLock) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> angle(-units::kPi, units::kPi);
  for (const double vertical : {units::kPi / 2, -units::kPi / 2}) {
    for (int exponent = 0; exponent >= -18; --exponent) {
      for (int i = 0; i < 50; ++i) {
        const double pitch = vertical + (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent);
        const Quaternion q = quaternion_from_rpy({angle(generator), pitch, angle(generator)});
        const RollPitchYaw rpy = rpy_from_quaternion(q);
        EXPECT_LE(std::abs(rpy.roll_rad), units::kPi);
        EXPECT_LE(std::abs(rpy.pitch_rad), units::kPi / 2);
        EXPECT_GE(rpy.yaw_rad, 0.0);
        EXPECT_LT(rpy.yaw_rad, 2.0 * units::kPi);
        // In the lock itself the roll is given up: up to half a turn of the little that is left of cos(pitch).
        EXPECT_LT(angle_between(quaternion_from_rpy(rpy), q), kRounding + 2.0 * kGimbalLockCosine) << pitch;
        EXPECT_LT(angle_between(quaternion_from_matrix(matrix_from_rpy(rpy)), q), kRounding + 2.0 * kGimbalLockCosine);
      }
    }
  }
}

TEST(Attitude, BothSignsOfAQuaternionAreOneRotation) {
  std::mt19937_64 generator(12);
  for (int i = 0; i < 1000; ++i) {
    Quaternion q = random_quaternion(generator);
    // Every third is a half turn, w = 0, where the sign has nothing to go by but the first component that is not 0.
    if (i % 3 == 0) q = canonical(Quaternion(0.0, i % 2 == 0 ? 0.0 : q.x(), q.y(), q.z()));
    const Quaternion negative(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_EQ(canonical(negative).coeffs(), canonical(q).coeffs());
    EXPECT_EQ(matrix_from_quaternion(negative), matrix_from_quaternion(q));
    EXPECT_EQ(rotation_vector_from_quaternion(negative), rotation_vector_from_quaternion(q));
    EXPECT_LT(angle_between(negative, q), kRounding);
  }
}

TEST(Attitude, QuaternionOfAMatrixIsTheSameWhicheverComponentIsLargest) {
  std::mt19937_64 generator(13);
  for (int i = 0; i < 4000; ++i) {
    const Quaternion random = random_quaternion(generator);
    Eigen::Vector4d components(random.w(), random.x(), random.y(), random.z());
    components[i % 4] *= 1e3;  // the branch by the largest
    components[(i / 4) % 4] *= 1e-9;
    const Quaternion q = canonical(Quaternion(components[0], components[1], components[2], components[3]));
    EXPECT_LT(angle_between(quaternion_from_matrix(matrix_from_quaternion(q)), q), kRounding);
  }
}

TEST(RotationVector, TurnsOverAtAHalfTurnWithoutLosingTheRotation) {
  const Vector3 axis = Vector3(2.0, -1.0, 2.0) / 3.0;
  for (const double beyond : {-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3}) {
    const Quaternion q = quaternion_from_rotation_vector((units::kPi + beyond) * axis);
    const Vector3 vector = rotation_vector_from_quaternion(q);
    EXPECT_LE(vector.norm(), units::kPi + kRounding);
    EXPECT_LT(angle_between(quaternion_from_rotation_vector(vector), q), kRounding) << beyond;
    if (std::abs(beyond) > 1e-12) {
      EXPECT_EQ(vector.dot(axis) > 0.0, beyond < 0.0);
    }
  }
}

TEST(RotationVector, ComesBackAtEverySize) {
  const Vector3 axis = Vector3(1.0, -2.0, 2.0) / 3.0;
  for (const double size : {0.0, 1e-300, 1e-20, 1e-9, 1.9e-4, 2.1e-4, 9.9e-3, 1.01e-2, 0.5, 3.0, 3.1415926}) {
    const Vector3 vector = size * axis;
    const Vector3 back = rotation_vector_from_quaternion(quaternion_from_rotation_vector(vector));
    EXPECT_LE((back - vector).norm(), kRounding * size) << size;
  }
}

TEST(RotationVector, IsTheShortestOfItsRotation) {
  const Vector3 back = rotation_vector_from_quaternion(quaternion_from_rotation_vector({0.0, 0.0, 6.0}));
  EXPECT_NEAR(back.z(), 6.0 - 2.0 * units::kPi, kRounding);
}

TEST(RotationVector, OfAQuaternionTurnsAsItsMatrix) {
  // exp of skew by its series: 20 terms of 1.2^n/n! leave 1e-17.
  const Vector3 vector(0.6, -0.8, 0.7);
  Matrix3 sum = Matrix3::Identity(), term = Matrix3::Identity();
  for (int n = 1; n <= 25; ++n) {
    term = term * skew(vector) / n;
    sum += term;
  }
  EXPECT_LT((matrix_from_quaternion(quaternion_from_rotation_vector(vector)) - sum).norm(), kRounding);
}

TEST(Skew, IsTheCrossProduct) {
  const Vector3 a(1.0, 2.0, 3.0), b(-4.0, 5.0, 0.5);
  EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(AngleBetween, SeesSmallDifferencesAndIgnoresTheSign) {
  std::mt19937_64 generator(4);
  for (int i = 0; i < 100; ++i) {
    const Quaternion q = random_quaternion(generator);
    const Quaternion turned = q * quaternion_from_rotation_vector({1e-12, 0.0, 0.0});
    EXPECT_NEAR(angle_between(q, turned), 1e-12, kRounding);
    EXPECT_NEAR(angle_between(q, Quaternion(-turned.w(), -turned.x(), -turned.y(), -turned.z())), 1e-12, kRounding);
  }
}

}  // namespace attitude_test
}  // namespace inslab::nav
