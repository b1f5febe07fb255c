#include "inslab/nav/gravity_along_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::nav {
namespace gravity_along_way_test {

// A row of steps of any lengths has the transition of the whole: x(s) by x(0) is the correlation over the variance.
TEST(GravityAlongWay, CorrelatesAsASecondOrderProcessWhateverTheSteps) {
  Eigen::Matrix2d through = Eigen::Matrix2d::Identity();
  double u = 0.0;
  for (const double step : {1e-7, 0.003, 0.4, 0.02, 1.3, 1e-5, 2.5}) {
    through = way_step(step).transition * through;
    u += step;
    EXPECT_NEAR(through(0, 0), (1.0 + u) * std::exp(-u), 1e-15) << u;
  }
}

TEST(GravityAlongWay, KeepsItsSigmaWhateverTheStepAndTakesWhatKnowsOfItAlong) {
  for (const double u : {0.0, 1e-7, 3e-4, 0.02, 0.6, 5.0}) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Identity(3, 3) * 4.0;
    P(0, 1) = P(1, 0) = 1.0;
    P(0, 2) = P(2, 0) = -0.5;
    carry(way_step(u), 4.0, 1, 2, P);
    EXPECT_NEAR(P(1, 1), 4.0, 1e-14);
    EXPECT_NEAR(P(2, 2), 4.0, 1e-14);
    EXPECT_NEAR(P(1, 2), 0.0, 1e-14);
    EXPECT_EQ(P, P.transpose());
    EXPECT_NEAR(P(0, 1), std::exp(-u) * (1.0 + u - 0.5 * u), 1e-15);
    EXPECT_NEAR(P(0, 2), std::exp(-u) * (-u - 0.5 * (1.0 - u)), 1e-15);
    EXPECT_EQ(P(0, 0), 4.0);
  }
}

// Of an x that is known with its change the way adds 4/3 u^3 sigma^2, to h 4 u sigma^2: the noise that drives it.
TEST(GravityAlongWay, BeginsToBeUnknownWithTheCubeOfTheWay) {
  for (const double u : {1e-9, 1e-6, 1e-3}) {
    const WayStep step = way_step(u);
    EXPECT_NEAR(step.noise(0, 0) / (4.0 / 3.0 * u * u * u), 1.0, 2.0 * u + 1e-12);
    EXPECT_NEAR(step.noise(1, 1) / (4.0 * u), 1.0, 3.0 * u + 1e-12);
  }
}

TEST(GravityAlongWay, OfAConstantOrAtRestGoesNowhere) {
  const Vector3 v_n(3.0, 4.0, 50.0);
  EXPECT_EQ(share_of_correlation({Vector3::Ones(), 0.0}, v_n, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(share_of_correlation({Vector3::Ones(), 100.0}, v_n, 2.0), 0.1);
  EXPECT_EQ(way_step(0.0).transition, Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
  EXPECT_EQ(way_step(0.0).noise, Eigen::Matrix2d(Eigen::Matrix2d::Zero()));
}

}  // namespace gravity_along_way_test
}  // namespace inslab::nav
