#include "inslab/models/navigation/covariance.hpp"

#include <gtest/gtest.h>

namespace inslab::reference_nav {
namespace covariance_test {

/// Some transition without zeros where the structure allows any number.
Transition any_transition() {
  Transition t;
  for (int i = 0; i < 81; ++i) t.nav_by_nav(i / 9, i % 9) = (i % 10 == 0 ? 1.0 : 0.0) + 0.01 * std::sin(i);
  for (int i = 0; i < 108; ++i) t.nav_by_sensor(i / 12, i % 12) = 0.02 * std::cos(i);
  for (int i = 0; i < 12; ++i) t.sensor_decay[i] = 1.0 - 0.01 * i;
  t.velocity_noise = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  t.attitude_noise = Eigen::Vector3d(0.3, 0.2, 0.1).asDiagonal();
  t.sensor_noise.setConstant(0.05);
  return t;
}

Covariance any_covariance() {
  Covariance P(Vector21::LinSpaced(0.5, 2.5));
  Vector21 x = Vector21::Zero();
  for (int i = 0; i < 5; ++i) P.update(Vector21::Random(), 1.0, 0.0, x);
  return P;
}

TEST(Covariance, ItsBlocksGoOnAsTheWholeMatrixWould) {
  const Transition t = any_transition();
  Covariance P = any_covariance();
  Matrix21 Phi = Matrix21::Zero(), Q = Matrix21::Zero();
  Phi.topLeftCorner<9, 9>() = t.nav_by_nav;
  Phi.topRightCorner<9, 12>() = t.nav_by_sensor;
  Phi.bottomRightCorner<12, 12>() = t.sensor_decay.asDiagonal();
  Q.block<3, 3>(kVelocity, kVelocity) = t.velocity_noise;
  Q.block<3, 3>(kAttitude, kAttitude) = t.attitude_noise;
  Q.diagonal().tail<12>() = t.sensor_noise;
  const Matrix21 expected = Phi * (P.matrix() + 0.5 * Q) * Phi.transpose() + 0.5 * Q;
  P.propagate(t);
  EXPECT_LT((P.matrix() - expected).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(P.matrix(), P.matrix().transpose());
}

TEST(Covariance, ScalarUpdatesOneByOneGiveWhatAllAtOnceDo) {
  Covariance P = any_covariance();
  const Matrix21 before = P.matrix();
  const Eigen::Matrix<double, 3, 21> H = Eigen::Matrix<double, 3, 21>::Random();
  const Eigen::Vector3d R(0.1, 0.2, 0.3), z(1.0, -2.0, 3.0);
  Vector21 x = Vector21::Zero();
  for (int i = 0; i < 3; ++i) P.update(H.row(i).transpose(), R[i], z[i], x);

  const Eigen::Matrix3d S = H * before * H.transpose() + Eigen::Matrix3d(R.asDiagonal());
  const Eigen::Matrix<double, 21, 3> K = before * H.transpose() * S.inverse();
  EXPECT_LT((x - K * z).norm(), 1e-12);
  EXPECT_LT((P.matrix() - (before - K * S * K.transpose())).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(P.matrix(), P.matrix().transpose());
}

TEST(Covariance, ForgettingLeavesNoTraceOfThreeErrors) {
  Covariance P = any_covariance();
  P.forget(kVelocity, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ((P.matrix().middleRows<3>(kVelocity).cwiseAbs().sum()), 6.0);
  EXPECT_EQ((P.matrix().block<3, 3>(kVelocity, kVelocity)),
            Eigen::Matrix3d(Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal()));
}

}  // namespace covariance_test
}  // namespace inslab::reference_nav
