#include "inslab/nav/rotation_spline.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "inslab/nav/attitude.hpp"

namespace inslab::nav {

namespace {

// Below this phi^2 the closed forms of A and B would lose more than three digits.
constexpr double kSeriesBelow = 1e-2;
constexpr int kMostIterations = 60;
// Rates that move by less than this of the largest one have arrived.
constexpr double kArrived = 1e-14;

/// Takes Phi' to omega and back.
Matrix3 right_jacobian(const Vector3& phi) {
  const RotationFactors factors(phi.squaredNorm());
  const Matrix3 K = skew(phi);
  return Matrix3::Identity() - factors.A * K + factors.B * K * K;
}
Matrix3 inverse_right_jacobian(const Vector3& phi) {
  const double phi2 = phi.squaredNorm();
  const RotationFactors factors(phi2);
  // (1 - (phi/2) cot(phi/2))/phi^2, where cot(phi/2) = S/(phi A).
  const double D = phi2 < kSeriesBelow ? 1.0 / 12.0 + phi2 / 720.0 * (1.0 + phi2 / 42.0 * (1.0 + phi2 / 40.0))
                                       : (factors.A - 0.5 * factors.S) / (phi2 * factors.A);
  const Matrix3 K = skew(phi);
  return Matrix3::Identity() + 0.5 * K + D * K * K;
}

/// The part of the angular acceleration at Phi that is quadratic in p = Phi': (d J(Phi)/dt) p.
Vector3 quadratic_part(const Vector3& phi, const Vector3& p) {
  const double phi2 = phi.squaredNorm();
  const RotationFactors factors(phi2);
  // Derivatives of A and B by phi^2.
  double dA, dB;
  if (phi2 < kSeriesBelow) {
    dA = -1.0 / 24.0 + phi2 / 360.0 * (1.0 - phi2 * 3.0 / 112.0 * (1.0 - phi2 * 2.0 / 135.0));
    dB = -1.0 / 120.0 + phi2 / 2520.0 * (1.0 - phi2 / 48.0 * (1.0 - phi2 * 2.0 / 165.0));
  } else {
    dA = (0.5 * factors.S - factors.A) / phi2;
    dB = (0.5 * factors.A - 1.5 * factors.B) / phi2;
  }
  const double phi2_rate = 2.0 * phi.dot(p);
  const Vector3 turned = phi.cross(p);
  return -dA * phi2_rate * turned + phi.cross(turned) * (dB * phi2_rate) + factors.B * p.cross(turned);
}

/// The block tridiagonal system for the rates w_k, with Theta_k the rotation vector from k to k+1, J_k its Jacobian:
/// (2/h_(k-1)) J w_(k-1) + (4/h_(k-1) + 4/h_k) w_k + (2/h_k) J^-1 w_(k+1)
///   = 6 Theta_(k-1)/h_(k-1)^2 + 6 Theta_k/h_k^2 - quadratic_part(Theta_(k-1), J^-1 w_k).
class RateSystem {
 public:
  RateSystem(const std::vector<Quaternion>& q, const std::vector<double>& h) : h_(h), theta_(h.size()) {
    for (std::size_t k = 0; k < h.size(); ++k) {
      theta_[k] = rotation_vector_from_quaternion(q[k].conjugate() * q[k + 1]);
    }
    above_.resize(h.size());
  }

  std::vector<Vector3> first_guess() const {
    std::vector<Vector3> w(h_.size() + 1, Vector3::Zero());
    for (std::size_t k = 0; k < h_.size(); ++k) {
      w[k] += 0.5 * theta_[k] / h_[k];
      w[k + 1] += 0.5 * theta_[k] / h_[k];
    }
    w.front() *= 2.0;
    w.back() *= 2.0;
    return w;
  }

  /// Solves with the quadratic terms at `w`, replaces it, and returns the largest change and where it is.
  std::pair<double, std::size_t> improve(std::vector<Vector3>& w) {
    const std::size_t n = h_.size();
    std::vector<Vector3>& solved = solved_;
    solved.resize(n + 1);
    for (std::size_t k = 0; k <= n; ++k) {
      Matrix3 pivot = Matrix3::Zero();
      Vector3 right = Vector3::Zero();
      if (k > 0) {
        const Vector3& before = theta_[k - 1];
        const double h = h_[k - 1];
        const Matrix3 below = 2.0 / h * right_jacobian(before);
        pivot += 4.0 / h * Matrix3::Identity() - below * above_[k - 1];
        right += 6.0 / (h * h) * before - quadratic_part(before, inverse_right_jacobian(before) * w[k]) -
                 below * solved[k - 1];
      }
      if (k < n) {
        pivot += 4.0 / h_[k] * Matrix3::Identity();
        right += 6.0 / (h_[k] * h_[k]) * theta_[k];
      }
      const Matrix3 inverse = pivot.inverse();
      if (k < n) above_[k] = inverse * (2.0 / h_[k] * inverse_right_jacobian(theta_[k]));
      solved[k] = inverse * right;
    }
    std::pair<double, std::size_t> change{0.0, 0};
    for (std::size_t k = n + 1; k-- > 0;) {
      if (k < n) solved[k] -= above_[k] * solved[k + 1];
      change = std::max(change, {(solved[k] - w[k]).norm(), k});
    }
    std::swap(w, solved);
    return change;
  }

 private:
  const std::vector<double>& h_;
  std::vector<Vector3> theta_;
  std::vector<Matrix3> above_;
  std::vector<Vector3> solved_;
};

double largest(const std::vector<Vector3>& vectors) {
  double norm = 0.0;
  for (const Vector3& v : vectors) norm = std::max(norm, v.norm());
  return norm;
}

}  // namespace

RotationFactors::RotationFactors(double phi_squared) {
  const double x = phi_squared;
  if (x < kSeriesBelow) {
    // Taylor series: the terms left out are below x^5/1e9 = 1e-19.
    A = 0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0)));
    B = 1.0 / 6.0 - x / 120.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0)));
    S = 1.0 - x * B;
    return;
  }
  const double phi = std::sqrt(x);
  const double s = std::sin(0.5 * phi), c = std::cos(0.5 * phi);
  S = 2.0 * s * c / phi;
  A = 2.0 * s * s / x;
  B = (1.0 - S) / x;
}

Vector3 rate_from_rotation_vector(const RotationFactors& factors, const Vector3& phi, const Vector3& phi_rate) {
  const Vector3 turned = phi.cross(phi_rate);
  return phi_rate - factors.A * turned + factors.B * phi.cross(turned);
}

Quaternion RotationPiece::q_ab(double t_s) const { return q_start * quaternion_from_rotation_vector(phi(t_s)); }

Vector3 RotationPiece::omega_ab_b(double t_s) const {
  const Vector3 angle = phi(t_s);
  return rate_from_rotation_vector(RotationFactors(angle.squaredNorm()), angle, phi_rate(t_s));
}

RotationSpline::RotationSpline(std::vector<Quaternion> q_ab, std::vector<double> intervals_s)
    : q_ab_(std::move(q_ab)), intervals_s_(std::move(intervals_s)) {
  if (q_ab_.size() < 2 || q_ab_.size() != intervals_s_.size() + 1) {
    throw std::invalid_argument(
        "a rotation spline has at least two rotations and an interval between each and the next");
  }
  for (const double interval_s : intervals_s_) {
    if (!(interval_s > 0.0)) throw std::invalid_argument("an interval of a rotation spline is not above 0");
  }
  RateSystem system(q_ab_, intervals_s_);
  omega_ab_b_ = system.first_guess();
  std::pair<double, std::size_t> change;
  for (int i = 0; i < kMostIterations; ++i) {
    change = system.improve(omega_ab_b_);
    if (change.first <= kArrived * largest(omega_ab_b_)) return;
  }
  throw std::domain_error("between rotations " + std::to_string(change.second) + " and " +
                          std::to_string(change.second + 1) + " the attitude turns too far for a smooth rate");
}

RotationPiece RotationSpline::piece(std::size_t index) const {
  const double h = intervals_s_[index];
  const Vector3 theta = rotation_vector_from_quaternion(q_ab_[index].conjugate() * q_ab_[index + 1]);
  const Vector3& p0 = omega_ab_b_[index];
  const Vector3 p1 = inverse_right_jacobian(theta) * omega_ab_b_[index + 1];
  return {q_ab_[index], p0, (3.0 / h * theta - 2.0 * p0 - p1) / h, (p0 + p1 - 2.0 / h * theta) / (h * h)};
}

}  // namespace inslab::nav
