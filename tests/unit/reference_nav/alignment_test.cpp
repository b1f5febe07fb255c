#include "nav/alignment.hpp"

#include <gtest/gtest.h>

#include "nav/attitude.hpp"
#include "nav/geodesy.hpp"
#include "nav/gravity.hpp"

namespace inslab::nav {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kLatitude_rad = 30.53 * kRadPerDeg;

double gravity_m_per_s2() { return Gravity().g_n(Geodetic{kLatitude_rad, 0.0, 0.0}).norm(); }

StaticMeans perfect_means(const Matrix3& C_nb) {
  StaticMeans means;
  means.f_b = C_nb.transpose() * Vector3(0.0, 0.0, -gravity_m_per_s2());
  means.omega_ib_b = C_nb.transpose() * omega_ie_n(kLatitude_rad);
  return means;
}

std::string refusal(const StaticMeans& means, double latitude_rad = kLatitude_rad) {
  const auto result = coarse_alignment(means, latitude_rad, gravity_m_per_s2(), {});
  const auto* reason = std::get_if<std::string>(&result);
  return reason != nullptr ? *reason : "";
}

TEST(CoarseAlignment, FindsAnyAttitudeFromPerfectMeans) {
  for (const RollPitchYaw rpy : {RollPitchYaw{0.0, 0.0, 0.0}, {1.0, -0.5, 4.0}, {-2.0, 1.2, 2.0}}) {
    const Matrix3 C_nb = matrix_from_rpy(rpy);
    const auto result = coarse_alignment(perfect_means(C_nb), kLatitude_rad, gravity_m_per_s2(), {});
    ASSERT_TRUE(std::holds_alternative<Matrix3>(result));
    EXPECT_LT((std::get<Matrix3>(result) - C_nb).norm(), 1e-14);
  }
}

TEST(CoarseAlignment, AnEastGyroBiasTurnsYawByTheBiasOverTheHorizontalRate) {
  StaticMeans means = perfect_means(Matrix3::Identity());
  const double horizontal_rad_per_s = means.omega_ib_b.x();
  means.omega_ib_b.y() += 1e-4 * horizontal_rad_per_s;
  const auto result = coarse_alignment(means, kLatitude_rad, gravity_m_per_s2(), {});
  // atan(1e-4) is 1e-4 less 3e-13.
  EXPECT_NEAR(wrapped_to_pi(rpy_from_matrix(std::get<Matrix3>(result)).yaw_rad), -1e-4, 1e-12);
}

TEST(CoarseAlignment, RefusesNearThePole) {
  EXPECT_NE(refusal(perfect_means(Matrix3::Identity()), 89.5 * kRadPerDeg).find("pole"), std::string::npos);
}

TEST(CoarseAlignment, RefusesGyrosWhoseBiasSwampsTheEarth) {
  StaticMeans means = perfect_means(Matrix3::Identity());
  means.omega_ib_b *= 2.0;
  EXPECT_NE(refusal(means).find("bias swamps"), std::string::npos);
}

TEST(CoarseAlignment, RefusesAnImuThatMoved) {
  StaticMeans means = perfect_means(Matrix3::Identity());
  means.f_spread_b = Vector3(0.0, 0.0, 1.0);
  EXPECT_NE(refusal(means).find("moving"), std::string::npos);
  means.f_spread_b.setZero();
  means.f_b *= 1.2;
  EXPECT_NE(refusal(means).find("long"), std::string::npos);
}

TEST(CoarseAlignment, RefusesWhatIsNoNumber) {
  StaticMeans means = perfect_means(Matrix3::Identity());
  means.f_b.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(means), "the means are not finite");
}

TEST(Levelled, FindsRollAndPitchAndTakesTheYawGiven) {
  const Matrix3 C_nb = matrix_from_rpy({0.3, -0.2, 1.5});
  const auto result = levelled(perfect_means(C_nb), 1.5, gravity_m_per_s2(), {});
  ASSERT_TRUE(std::holds_alternative<Matrix3>(result));
  EXPECT_LT((std::get<Matrix3>(result) - C_nb).norm(), 1e-14);
}

}  // namespace
}  // namespace inslab::nav
