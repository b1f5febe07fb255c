#include "inslab/nav/symmetric.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>

namespace inslab::nav {
namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// Positive definite, its eigenvalues five decades apart.
Matrix7 a_covariance() {
  std::srand(7);
  const Matrix7 half = Matrix7::Random();
  Matrix7 P = half * half.transpose() + 1e-5 * Matrix7::Identity();
  P.row(0) *= 1e-2;
  P.col(0) *= 1e-2;
  return P;
}

TEST(Symmetric, CarriedIsTheProductThatEigenFinds) {
  const Matrix7 P = a_covariance();
  const Eigen::Matrix<double, 3, 7> A = Eigen::Matrix<double, 3, 7>::Random();
  const Eigen::Matrix3d expected = A * P * A.transpose();
  EXPECT_LT((carried(A, P) - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(Symmetric, CarriedTakesAPartOfALargerMatrix) {
  const Matrix7 P = a_covariance();
  const Eigen::Matrix2d A = Eigen::Matrix2d::Random(), part = P.block<2, 2>(3, 3);
  EXPECT_LT((carried(A, P.block<2, 2>(3, 3)) - A * part * A.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

// The condition is some 1e7: eps times it is 2e-9.
TEST(Symmetric, InverseTimesTheMatrixIsTheIdentity) {
  const Matrix7 P = a_covariance();
  EXPECT_LT((inverse_of_symmetric(P) * P - Matrix7::Identity()).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Symmetric, SquaredNormalisedIsThatOfTheInverse) {
  const Matrix7 P = a_covariance();
  const Eigen::Matrix<double, 7, 1> x = Eigen::Matrix<double, 7, 1>::Random();
  const double expected = x.dot(P.inverse() * x);
  EXPECT_NEAR(squared_normalised(P, x), expected, 1e-8 * expected);
}

TEST(Symmetric, WhatIsNotPositiveDefiniteHasNoFiniteAnswer) {
  const Eigen::Matrix2d singular = Eigen::Matrix2d::Ones();
  EXPECT_FALSE(std::isfinite(squared_normalised(singular, Eigen::Vector2d(1.0, 2.0))));
  EXPECT_FALSE(std::isfinite(squared_normalised(-Eigen::Matrix2d::Identity(), Eigen::Vector2d(1.0, 2.0))));
  EXPECT_FALSE(inverse_of_symmetric(singular).allFinite());
}

}  // namespace
}  // namespace inslab::nav
