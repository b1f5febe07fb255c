#pragma once

#include <Eigen/Core>

namespace inslab::nav {

/// What is done with covariances of any size, where it is not done for every sample. Eigen's own products and
/// decompositions are built anew for each fixed size, which costs a compiler a second or two apiece; these are built
/// once.

/// A P A^T, n x n for an A of n x m and a P of m x m.
Eigen::MatrixXd carried(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& P);

/// x^T S^-1 x of a symmetric S; not a number, or infinite, when S is not positive definite.
double squared_normalised(const Eigen::Ref<const Eigen::MatrixXd>& S, const Eigen::Ref<const Eigen::VectorXd>& x);

/// The inverse of a symmetric S; has entries that are not finite when S is not positive definite.
Eigen::MatrixXd inverse_of_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& S);

}  // namespace inslab::nav
