#include "inslab/models/navigation/covariance.hpp"

#include <cmath>
#include <type_traits>

namespace inslab::navigation {

namespace {

/// So many rows that the compiler knows, or Eigen::Dynamic, in the memory of the largest.
template <int kRows, int kCols, int kMaxRows, int kMaxCols>
using Sized = Eigen::Matrix<double, kRows, kCols, 0, kRows == Eigen::Dynamic ? kMaxRows : kRows,
                            kCols == Eigen::Dynamic ? kMaxCols : kCols>;
template <int kChosen>
using NavByChosenOf = Sized<9, kChosen, 9, kMaxChosenStates>;
template <int kChosen>
using ChosenVectorOf = Sized<kChosen, 1, kMaxChosenStates, 1>;
template <int kChosen>
using ChosenMatrixOf = Sized<kChosen, kChosen, kMaxChosenStates, kMaxChosenStates>;
template <int kChosen>
inline constexpr int kStatesOf = kChosen == Eigen::Dynamic ? Eigen::Dynamic : kChosen + static_cast<int>(kNavStates);
template <int kChosen>
using StateVectorOf = Sized<kStatesOf<kChosen>, 1, kMaxStates, 1>;
template <int kChosen>
using StateMatrixOf = Sized<kStatesOf<kChosen>, kStatesOf<kChosen>, kMaxStates, kMaxStates>;

/// Calls `use` with the number of chosen states as the compiler is to see it.
template <class Use>
void with_size(Eigen::Index chosen, const Use& use) {
  switch (chosen) {
    case 12:
      return use(std::integral_constant<int, 12>());  // biases and scale factors
    case 15:
      return use(std::integral_constant<int, 15>());  // and a hard iron
    case 6:
      return use(std::integral_constant<int, 6>());  // biases
    default:
      return use(std::integral_constant<int, Eigen::Dynamic>());
  }
}

template <class Matrix>
void add_noise(const Transition& transition, Matrix& P) {
  P.template block<3, 3>(kVelocity, kVelocity) += 0.5 * transition.velocity_noise;
  P.template block<3, 3>(kAttitude, kAttitude) += 0.5 * transition.attitude_noise;
  P.diagonal().tail(transition.chosen_noise.size()) += 0.5 * transition.chosen_noise;
}

template <int kChosen>
void propagate_sized(const Transition& transition, StateMatrix& storage) {
  const Eigen::Index states = storage.rows(), chosen = states - kNavStates;
  Eigen::Map<StateMatrixOf<kChosen>> P(storage.data(), states, states);
  const Eigen::Map<const NavByChosenOf<kChosen>> B(transition.nav_by_chosen.data(), 9, chosen);
  const Eigen::Map<const ChosenVectorOf<kChosen>> decay(transition.decay.data(), chosen);
  const Matrix9& A = transition.nav_by_nav;
  add_noise(transition, P);
  const Matrix9 P_nn = P.template topLeftCorner<9, 9>();
  const NavByChosenOf<kChosen> P_nc = P.template topRightCorner<9, kChosen>(9, chosen);
  const ChosenMatrixOf<kChosen> P_cc = P.template bottomRightCorner<kChosen, kChosen>(chosen, chosen);

  // lazyProduct: at these sizes the unrolled sums are quicker than Eigen's blocked product.
  const Matrix9 left = A.lazyProduct(P_nn) + B.lazyProduct(P_nc.transpose());
  const NavByChosenOf<kChosen> right = A.lazyProduct(P_nc) + B.lazyProduct(P_cc);
  const Matrix9 nav = left.lazyProduct(A.transpose()) + right.lazyProduct(B.transpose());
  P.template topLeftCorner<9, 9>() = 0.5 * (nav + nav.transpose());
  P.template topRightCorner<9, kChosen>(9, chosen) = right * decay.asDiagonal();
  P.template bottomLeftCorner<kChosen, 9>(chosen, 9) = P.template topRightCorner<9, kChosen>(9, chosen).transpose();
  P.template bottomRightCorner<kChosen, kChosen>(chosen, chosen) =
      P_cc.cwiseProduct((decay * decay.transpose()).eval());
  add_noise(transition, P);
}

template <int kChosen>
void update_sized(const StateVector& h_of, double variance, double innovation, StateVector& x_of,
                  StateMatrix& storage) {
  const Eigen::Index states = storage.rows();
  Eigen::Map<StateMatrixOf<kChosen>> P(storage.data(), states, states);
  const Eigen::Map<const StateVectorOf<kChosen>> h(h_of.data(), states);
  Eigen::Map<StateVectorOf<kChosen>> x(x_of.data(), states);
  const StateVectorOf<kChosen> Ph = P * h;
  const double innovation_variance = h.dot(Ph) + variance;
  x += Ph * ((innovation - h.dot(x)) / innovation_variance);
  // The product of two entries of Ph is the same in both orders, so P stays symmetric.
  const StateVectorOf<kChosen> scaled = Ph / std::sqrt(innovation_variance);
  P -= scaled * scaled.transpose();
}

}  // namespace

void Covariance::propagate(const Transition& transition) {
  with_size(size() - kNavStates, [&](auto chosen) { propagate_sized<decltype(chosen)::value>(transition, P_); });
  if (!transition.gravity) return;
  const Transition::Gravity& gravity = *transition.gravity;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    nav::carry(gravity.way, gravity.variance[axis], gravity.first + axis, gravity.first_change + axis, P_);
  }
}

void Covariance::update(const StateVector& h, double variance, double innovation, StateVector& x) {
  with_size(size() - kNavStates,
            [&](auto chosen) { update_sized<decltype(chosen)::value>(h, variance, innovation, x, P_); });
}

void Covariance::forget(Eigen::Index first, const Eigen::Vector3d& variances) {
  P_.middleRows<3>(first).setZero();
  P_.middleCols<3>(first).setZero();
  P_.diagonal().segment<3>(first) = variances;
}

}  // namespace inslab::navigation
