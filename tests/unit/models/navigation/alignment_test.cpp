#include "inslab/nav/alignment.hpp"

#include <gtest/gtest.h>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::navigation {
namespace alignment_test {

constexpr double kLatitude_rad = 30.53 * units::kDeg;

double gravity_m_per_s2() { return nav::Gravity().g_n(nav::Geodetic{kLatitude_rad, 0.0, 0.0}).norm(); }

nav::StaticMeans perfect_means(const nav::Matrix3& C_nb) {
  nav::StaticMeans means;
  means.f_b = C_nb.transpose() * nav::Vector3(0.0, 0.0, -gravity_m_per_s2());
  means.omega_ib_b = C_nb.transpose() * nav::omega_ie_n(kLatitude_rad);
  return means;
}

std::string refusal(const nav::StaticMeans& means, double latitude_rad = kLatitude_rad) {
  const auto result = nav::coarse_alignment(means, latitude_rad, gravity_m_per_s2(), {});
  const auto* reason = std::get_if<std::string>(&result);
  return reason != nullptr ? *reason : "";
}

TEST(CoarseAlignment, FindsAnyAttitudeFromPerfectMeans) {
  for (const nav::RollPitchYaw rpy : {nav::RollPitchYaw{0.0, 0.0, 0.0}, {1.0, -0.5, 4.0}, {-2.0, 1.2, 2.0}}) {
    const nav::Matrix3 C_nb = nav::matrix_from_rpy(rpy);
    const auto result = nav::coarse_alignment(perfect_means(C_nb), kLatitude_rad, gravity_m_per_s2(), {});
    ASSERT_TRUE(std::holds_alternative<nav::Matrix3>(result));
    EXPECT_LT((std::get<nav::Matrix3>(result) - C_nb).norm(), 1e-14);
  }
}

// Every 15 deg of roll and yaw, every 7.5 deg of pitch and up to the last thousandth of a degree before the vertical,
// in both hemispheres: C_nb itself has no gimbal lock. The rounding of the cross product is over the cosine of the
// latitude, 1e-16 / cos(70 deg) some times.
TEST(CoarseAlignment, FindsAttitudesAllAroundAndUpToGimbalLock) {
  std::vector<double> pitches_deg{-90.0, -89.999, -89.9, 89.9, 89.999, 90.0};
  for (double pitch_deg = -82.5; pitch_deg < 90.0; pitch_deg += 7.5) pitches_deg.push_back(pitch_deg);
  double largest = 0.0;
  for (const double latitude_rad : {-70.0 * units::kDeg, 0.0, kLatitude_rad}) {
    const double gravity = nav::Gravity().g_n(nav::Geodetic{latitude_rad, 0.0, 0.0}).norm();
    for (const double pitch_deg : pitches_deg) {
      for (double roll_deg = -180.0; roll_deg < 180.0; roll_deg += 15.0) {
        for (double yaw_deg = 0.0; yaw_deg < 360.0; yaw_deg += 15.0) {
          const nav::Matrix3 C_nb =
              nav::matrix_from_rpy({roll_deg * units::kDeg, pitch_deg * units::kDeg, yaw_deg * units::kDeg});
          nav::StaticMeans means;
          means.f_b = C_nb.transpose() * nav::Vector3(0.0, 0.0, -gravity);
          means.omega_ib_b = C_nb.transpose() * nav::omega_ie_n(latitude_rad);
          const auto result = nav::coarse_alignment(means, latitude_rad, gravity, {});
          ASSERT_TRUE(std::holds_alternative<nav::Matrix3>(result));
          largest = std::max(largest, (std::get<nav::Matrix3>(result) - C_nb).cwiseAbs().maxCoeff());
        }
      }
    }
  }
  EXPECT_LT(largest, 3e-15);
}

// phi_D = -b_E/(omega_e cos L) and a level error of b/g, whatever the attitude: the errors belong to n. To first order;
// the second is their square, 1e-8 and less.
TEST(CoarseAlignment, BiasesTiltAndTurnAsTheirFormulasSayInAnyAttitude) {
  const double horizontal_rad_per_s = nav::omega_ie_n(kLatitude_rad).x();
  for (const nav::RollPitchYaw rpy :
       {nav::RollPitchYaw{0.0, 0.0, 0.0}, {1.0, -0.5, 4.0}, {-2.0, 1.5, 2.0}, {3.0, -1.57, 5.0}}) {
    const nav::Matrix3 C_nb = nav::matrix_from_rpy(rpy);
    nav::StaticMeans means = perfect_means(C_nb);
    means.f_b += C_nb.transpose() * nav::Vector3(1e-4, 0.0, 0.0) * gravity_m_per_s2();
    means.omega_ib_b += C_nb.transpose() * nav::Vector3(0.0, 1e-4 * horizontal_rad_per_s, 0.0);
    const nav::Matrix3 found =
        std::get<nav::Matrix3>(nav::coarse_alignment(means, kLatitude_rad, gravity_m_per_s2(), {}));
    const nav::Matrix3 error = found * C_nb.transpose();  // exp(-phi)
    // North force of 1e-4 g: the specific force leans by 1e-4 about east, and the computed level with it.
    EXPECT_NEAR(std::abs(error(0, 2)), 1e-4, 1e-7);
    EXPECT_NEAR(std::abs(error(1, 2)), 0.0, 1e-7);
    // East rate of 1e-4 of the horizontal rate: yaw turns by as much.
    EXPECT_NEAR(std::abs(error(1, 0)), 1e-4, 1e-7);
  }
}

TEST(CoarseAlignment, AnEastGyroBiasTurnsYawByTheBiasOverTheHorizontalRate) {
  nav::StaticMeans means = perfect_means(nav::Matrix3::Identity());
  const double horizontal_rad_per_s = means.omega_ib_b.x();
  means.omega_ib_b.y() += 1e-4 * horizontal_rad_per_s;
  const auto result = nav::coarse_alignment(means, kLatitude_rad, gravity_m_per_s2(), {});
  // atan(1e-4) is 1e-4 less 3e-13.
  EXPECT_NEAR(nav::wrapped_to_pi(nav::rpy_from_matrix(std::get<nav::Matrix3>(result)).yaw_rad), -1e-4, 1e-12);
}

TEST(CoarseAlignment, RefusesNearThePole) {
  EXPECT_NE(refusal(perfect_means(nav::Matrix3::Identity()), 89.5 * units::kDeg).find("pole"), std::string::npos);
}

TEST(CoarseAlignment, RefusesGyrosWhoseBiasSwampsTheEarth) {
  nav::StaticMeans means = perfect_means(nav::Matrix3::Identity());
  means.omega_ib_b *= 2.0;
  EXPECT_NE(refusal(means).find("bias swamps"), std::string::npos);
}

TEST(CoarseAlignment, RefusesAnImuThatMoved) {
  nav::StaticMeans means = perfect_means(nav::Matrix3::Identity());
  means.f_spread_b = nav::Vector3(0.0, 0.0, 1.0);
  EXPECT_NE(refusal(means).find("moving"), std::string::npos);
  means.f_spread_b.setZero();
  means.f_b *= 1.2;
  EXPECT_NE(refusal(means).find("long"), std::string::npos);
}

TEST(CoarseAlignment, RefusesWhatIsNoNumber) {
  nav::StaticMeans means = perfect_means(nav::Matrix3::Identity());
  means.f_b.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(means), "the means are not finite");
}

TEST(Levelled, FindsRollAndPitchAndTakesTheYawGiven) {
  const nav::Matrix3 C_nb = nav::matrix_from_rpy({0.3, -0.2, 1.5});
  const auto result = nav::levelled(perfect_means(C_nb), 1.5, gravity_m_per_s2(), {});
  ASSERT_TRUE(std::holds_alternative<nav::Matrix3>(result));
  EXPECT_LT((std::get<nav::Matrix3>(result) - C_nb).norm(), 1e-14);
}

}  // namespace alignment_test
}  // namespace inslab::navigation
