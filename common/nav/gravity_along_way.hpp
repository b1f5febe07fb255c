#pragma once

#include <Eigen/Core>
#include <cmath>

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// What may be known beforehand of gravity's departure from its model along a vehicle's way: each axis of n by itself a
/// process of second order in the distance s over the ground,
///
///   D dx/ds = h,   D dh/ds = -x - 2 h + white noise,
///
/// whose x correlates as sigma^2 (1 + s/D) exp(-s/D), and whose h, the change over one D, has the sigma of x and knows
/// nothing of it. A departure has a slope everywhere, which a process of first order has not. Source: A. Gelb (ed.),
/// Applied Optimal Estimation (1974), table 2.2-1.
struct GravityAlongWay {
  Vector3 sigma_n = Vector3::Zero();  ///< of x and of h, m/s^2
  double correlation_m = 0.0;         ///< D; 0: a constant
};

/// How x and h go on over a part of the way.
struct WayStep {
  Eigen::Matrix2d transition = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< that comes in, for a sigma of 1
  double mean_by_change = 0.0;                      ///< the mean of x over it is x and so much of h, to first order
};

namespace detail {
/// 1 - exp(-z) (1 + z + z^2/2), without the cancellation that leaves z^3/6.
inline double beyond_second_order(double z) {
  if (z > 1.0) return 1.0 - std::exp(-z) * (1.0 + z + 0.5 * z * z);
  double term = z * z * z / 6.0, sum = term;
  for (int k = 4; term > 1e-17 * sum; ++k) sum += term *= z / k;
  return std::exp(-z) * sum;
}
}  // namespace detail

/// Over `u` of a correlation distance: exact.
inline WayStep way_step(double u) {
  const double fall = std::exp(-u), squared = fall * fall;
  WayStep step;
  step.transition << fall * (1.0 + u), fall * u, -fall * u, fall * (1.0 - u);
  const double together = 2.0 * u * u * squared;
  step.noise << detail::beyond_second_order(2.0 * u), together, together,
      -std::expm1(-2.0 * u) + squared * (2.0 * u - 2.0 * u * u);
  step.mean_by_change = 0.5 * u;
  return step;
}

/// The share of D that a time at this speed over the ground leads on by.
inline double share_of_correlation(const GravityAlongWay& along_way, const Vector3& v_n, double dt_s) {
  return along_way.correlation_m > 0.0 ? v_n.head<2>().norm() * dt_s / along_way.correlation_m : 0.0;
}

/// One axis of a symmetric covariance goes on by the step: `x` and `h` are the rows of its two states. It stays
/// symmetric to the bit.
template <class Covariance>
void carry(const WayStep& step, double variance, Eigen::Index x, Eigen::Index h, Covariance& P) {
  const auto of_x = P.row(x).eval();
  const auto of_h = P.row(h).eval();
  P.row(x) = step.transition(0, 0) * of_x + step.transition(0, 1) * of_h;
  P.row(h) = step.transition(1, 0) * of_x + step.transition(1, 1) * of_h;
  Eigen::Matrix2d own;
  own << P(x, x), P(x, h), P(h, x), P(h, h);
  own = (own * step.transition.transpose() + variance * step.noise).eval();
  P.col(x) = P.row(x).transpose();
  P.col(h) = P.row(h).transpose();
  P(x, x) = own(0, 0);
  P(h, h) = own(1, 1);
  P(x, h) = P(h, x) = 0.5 * (own(0, 1) + own(1, 0));
}

}  // namespace inslab::nav
