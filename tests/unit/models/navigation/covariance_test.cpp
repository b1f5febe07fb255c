#include "inslab/models/navigation/covariance.hpp"

#include <gtest/gtest.h>

namespace inslab::navigation {
namespace covariance_test {

/// Beside the nine: none, sizes that are compiled as such, others.
constexpr Eigen::Index kChosen[] = {0, 3, 6, 9, 12};

/// Some transition without zeros where the structure allows any number.
Transition any_transition(Eigen::Index chosen) {
  Transition t;
  for (int i = 0; i < 81; ++i) t.nav_by_nav(i / 9, i % 9) = (i % 10 == 0 ? 1.0 : 0.0) + 0.01 * std::sin(i);
  t.nav_by_chosen.resize(9, chosen);
  for (Eigen::Index i = 0; i < 9 * chosen; ++i) t.nav_by_chosen(i / chosen, i % chosen) = 0.02 * std::cos(i);
  t.decay.resize(chosen);
  for (Eigen::Index i = 0; i < chosen; ++i) t.decay[i] = 1.0 - 0.01 * static_cast<double>(i);
  t.velocity_noise = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  t.attitude_noise = Eigen::Vector3d(0.3, 0.2, 0.1).asDiagonal();
  t.chosen_noise.setConstant(chosen, 0.05);
  return t;
}

Covariance any_covariance(Eigen::Index chosen) {
  const Eigen::Index states = kNavStates + chosen;
  Covariance P(StateVector::LinSpaced(states, 0.5, 2.5));
  StateVector x = StateVector::Zero(states);
  for (int i = 0; i < 5; ++i) P.update(StateVector::Random(states), 1.0, 0.0, x);
  return P;
}

TEST(Covariance, ItsBlocksGoOnAsTheWholeMatrixWould) {
  for (const Eigen::Index chosen : kChosen) {
    const Eigen::Index states = kNavStates + chosen;
    const Transition t = any_transition(chosen);
    Covariance P = any_covariance(chosen);
    Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(states, states), Q = Eigen::MatrixXd::Zero(states, states);
    Phi.topLeftCorner<9, 9>() = t.nav_by_nav;
    Phi.topRightCorner(9, chosen) = t.nav_by_chosen;
    Phi.bottomRightCorner(chosen, chosen) = t.decay.asDiagonal();
    Q.block<3, 3>(kVelocity, kVelocity) = t.velocity_noise;
    Q.block<3, 3>(kAttitude, kAttitude) = t.attitude_noise;
    Q.diagonal().tail(chosen) = t.chosen_noise;
    const Eigen::MatrixXd expected = Phi * (P.matrix() + 0.5 * Q) * Phi.transpose() + 0.5 * Q;
    P.propagate(t);
    EXPECT_LT((P.matrix() - expected).cwiseAbs().maxCoeff(), 1e-13) << chosen;
    EXPECT_EQ(P.matrix(), P.matrix().transpose()) << chosen;
  }
}

TEST(Covariance, ScalarUpdatesOneByOneGiveWhatAllAtOnceDo) {
  for (const Eigen::Index chosen : kChosen) {
    const Eigen::Index states = kNavStates + chosen;
    Covariance P = any_covariance(chosen);
    const Eigen::MatrixXd before = P.matrix();
    const Eigen::MatrixXd H = Eigen::MatrixXd::Random(3, states);
    const Eigen::Vector3d R(0.1, 0.2, 0.3), z(1.0, -2.0, 3.0);
    StateVector x = StateVector::Zero(states);
    for (int i = 0; i < 3; ++i) P.update(H.row(i).transpose(), R[i], z[i], x);

    const Eigen::Matrix3d S = H * before * H.transpose() + Eigen::Matrix3d(R.asDiagonal());
    const Eigen::MatrixXd K = before * H.transpose() * S.inverse();
    EXPECT_LT((x - K * z).norm(), 1e-12) << chosen;
    EXPECT_LT((P.matrix() - (before - K * S * K.transpose())).cwiseAbs().maxCoeff(), 1e-13) << chosen;
    EXPECT_EQ(P.matrix(), P.matrix().transpose()) << chosen;
  }
}

TEST(Covariance, ForgettingLeavesNoTraceOfThreeErrors) {
  Covariance P = any_covariance(12);
  P.forget(kVelocity, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ((P.matrix().middleRows<3>(kVelocity).cwiseAbs().sum()), 6.0);
  EXPECT_EQ((P.matrix().block<3, 3>(kVelocity, kVelocity)),
            Eigen::Matrix3d(Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal()));
}

}  // namespace covariance_test
}  // namespace inslab::navigation
