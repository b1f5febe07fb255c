#pragma once

#include <optional>

#include "inslab/models/navigation/state_layout.hpp"
#include "inslab/nav/gravity_along_way.hpp"

namespace inslab::navigation {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
/// Columns, or entries, for the chosen blocks.
using NavByChosen = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, kMaxChosenStates>;
using ChosenVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxChosenStates, 1>;

/// How errors go on over a step: nav' = nav_by_nav nav + nav_by_chosen chosen, chosen' = decay chosen, and the variance
/// that comes in. The chosen errors are Gauss-Markov, each for itself, so theirs is a diagonal.
struct Transition {
  Matrix9 nav_by_nav;
  NavByChosen nav_by_chosen;
  ChosenVector decay;
  Eigen::Matrix3d velocity_noise;  ///< (m/s)^2, n
  Eigen::Matrix3d attitude_noise;  ///< rad^2, n
  ChosenVector chosen_noise;       ///< variances

  /// The departure of gravity changes with the way, after all else of the step.
  struct Gravity {
    nav::WayStep way;
    Eigen::Vector3d variance;  ///< (m/s^2)^2, n
    Eigen::Index first;        ///< of the blocks' states
    Eigen::Index first_change;
  };
  std::optional<Gravity> gravity = std::nullopt;
};

/// The covariance of the errors of a layout. Symmetric to the bit after every function.
///
/// The size is the layout's, the memory that of the largest, so nothing is allocated. Sizes in common use are compiled
/// as such (covariance.cpp): the compiler unrolls what it knows.
class Covariance {
 public:
  explicit Covariance(const StateVector& sigmas) : P_(sigmas.cwiseAbs2().asDiagonal()) {}
  /// Of errors that know of each other; made symmetric.
  static Covariance of(const StateMatrix& matrix) {
    Covariance covariance(StateVector::Zero(matrix.rows()));
    covariance.P_ = 0.5 * (matrix + matrix.transpose());
    return covariance;
  }

  const StateMatrix& matrix() const { return P_; }
  Eigen::Index size() const { return P_.rows(); }

  /// P <- Phi (P + Q/2) Phi^T + Q/2: half the noise comes in at the step's beginning, half at its end.
  void propagate(const Transition& transition);

  /// One scalar measurement of variance `variance` whose error is `h` times the state: corrects `x` by the
  /// `innovation` (predicted less measured, before any correction in x) and P. Several uncorrelated measurements, one
  /// after the other, give what all at once would.
  void update(const StateVector& h, double variance, double innovation, StateVector& x);

  /// Adds a variance to three errors that were not in the model.
  void add(Eigen::Index first, const Eigen::Matrix3d& variance) { P_.block<3, 3>(first, first) += variance; }

  /// Forgets what is known of three errors and gives them new, uncorrelated variances.
  void forget(Eigen::Index first, const Eigen::Vector3d& variances);

 private:
  StateMatrix P_;
};

}  // namespace inslab::navigation
