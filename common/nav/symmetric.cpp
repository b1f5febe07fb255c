#include "inslab/nav/symmetric.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::nav {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Cholesky's L with S = L L^T, of which S's lower triangle is read; above the diagonal it is 0.
MatrixXd lower_root(const Eigen::Ref<const MatrixXd>& S) {
  const Index n = S.rows();
  MatrixXd L = MatrixXd::Zero(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      double sum = S(i, j);
      for (Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = i == j ? std::sqrt(sum) : sum / L(j, j);
    }
  }
  return L;
}

/// Makes x the y of L y = x.
void solve_lower(const MatrixXd& L, VectorXd& x) {
  for (Index i = 0; i < L.rows(); ++i) {
    for (Index k = 0; k < i; ++k) x(i) -= L(i, k) * x(k);
    x(i) /= L(i, i);
  }
}

}  // namespace

MatrixXd carried(const Eigen::Ref<const MatrixXd>& A, const Eigen::Ref<const MatrixXd>& P) {
  const Index n = A.rows(), m = A.cols();
  MatrixXd AP = MatrixXd::Zero(n, m), result = MatrixXd::Zero(n, n);
  for (Index j = 0; j < m; ++j) {
    for (Index k = 0; k < m; ++k) {
      for (Index i = 0; i < n; ++i) AP(i, j) += A(i, k) * P(k, j);
    }
  }
  for (Index j = 0; j < n; ++j) {
    for (Index k = 0; k < m; ++k) {
      for (Index i = 0; i < n; ++i) result(i, j) += AP(i, k) * A(j, k);
    }
  }
  return result;
}

double squared_normalised(const Eigen::Ref<const MatrixXd>& S, const Eigen::Ref<const VectorXd>& x) {
  VectorXd y = x;
  solve_lower(lower_root(S), y);
  double sum = 0.0;
  for (const double each : y) sum += each * each;
  return sum;
}

MatrixXd inverse_of_symmetric(const Eigen::Ref<const MatrixXd>& S) {
  const Index n = S.rows();
  const MatrixXd L = lower_root(S);
  MatrixXd inverse_of_L(n, n);
  for (Index j = 0; j < n; ++j) {
    VectorXd column = VectorXd::Zero(n);
    column(j) = 1.0;
    solve_lower(L, column);
    inverse_of_L.col(j) = column;
  }
  MatrixXd inverse(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      double sum = 0.0;
      for (Index k = std::max(i, j); k < n; ++k) sum += inverse_of_L(k, i) * inverse_of_L(k, j);
      inverse(i, j) = sum;
    }
  }
  return inverse;
}

}  // namespace inslab::nav
