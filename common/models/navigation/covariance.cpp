#include "inslab/models/navigation/covariance.hpp"

#include <cmath>

namespace inslab::reference_nav {

namespace {

void add_noise(const Transition& transition, Matrix21& P) {
  P.block<3, 3>(kVelocity, kVelocity) += 0.5 * transition.velocity_noise;
  P.block<3, 3>(kAttitude, kAttitude) += 0.5 * transition.attitude_noise;
  P.diagonal().tail<kSensorStates>() += 0.5 * transition.sensor_noise;
}

}  // namespace

void Covariance::propagate(const Transition& transition) {
  add_noise(transition, P_);
  const Matrix9 P_nn = P_.topLeftCorner<9, 9>();
  const Matrix9x12 P_ns = P_.topRightCorner<9, 12>();
  const Eigen::Matrix<double, 12, 12> P_ss = P_.bottomRightCorner<12, 12>();
  const Matrix9& A = transition.nav_by_nav;
  const Matrix9x12& B = transition.nav_by_sensor;
  const auto D = transition.sensor_decay.asDiagonal();

  // lazyProduct: at these sizes the unrolled sums are quicker than Eigen's blocked product.
  const Matrix9 left = A.lazyProduct(P_nn) + B.lazyProduct(P_ns.transpose());
  const Matrix9x12 right = A.lazyProduct(P_ns) + B.lazyProduct(P_ss);
  const Matrix9 nav = left.lazyProduct(A.transpose()) + right.lazyProduct(B.transpose());
  P_.topLeftCorner<9, 9>() = 0.5 * (nav + nav.transpose());
  P_.topRightCorner<9, 12>() = right * D;
  P_.bottomLeftCorner<12, 9>() = P_.topRightCorner<9, 12>().transpose();
  P_.bottomRightCorner<12, 12>() =
      P_ss.cwiseProduct((transition.sensor_decay * transition.sensor_decay.transpose()).eval());
  add_noise(transition, P_);
}

void Covariance::update(const Vector21& h, double variance, double innovation, Vector21& x) {
  const Vector21 Ph = P_ * h;
  const double innovation_variance = h.dot(Ph) + variance;
  x += Ph * ((innovation - h.dot(x)) / innovation_variance);
  // The product of two entries of Ph is the same in both orders, so P stays symmetric.
  const Vector21 scaled = Ph / std::sqrt(innovation_variance);
  P_ -= scaled * scaled.transpose();
}

void Covariance::forget(StateIndex first, const Eigen::Vector3d& variances) {
  P_.middleRows<3>(first).setZero();
  P_.middleCols<3>(first).setZero();
  P_.diagonal().segment<3>(first) = variances;
}

}  // namespace inslab::reference_nav
