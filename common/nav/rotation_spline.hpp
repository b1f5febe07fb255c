#pragma once

#include <vector>

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// Functions of a rotation vector Phi of length phi, without cancellation near 0: S = sin(phi)/phi,
/// A = (1 - cos(phi))/phi^2, B = (phi - sin(phi))/phi^3.
struct RotationFactors {
  explicit RotationFactors(double phi_squared);

  double S;
  double A;
  double B;
};

/// One piece of a rotation spline: q_ab(t) = q_start * q(Phi(t)), with the rotation vector Phi a cubic in time. a is
/// any frame the rotations start from, b the one that turns.
struct RotationPiece {
  Quaternion q_start = Quaternion::Identity();
  Vector3 c1 = Vector3::Zero();  ///< rad/s; the rate at the start
  Vector3 c2 = Vector3::Zero();
  Vector3 c3 = Vector3::Zero();

  Vector3 phi(double t_s) const { return t_s * (c1 + t_s * (c2 + t_s * c3)); }
  Vector3 phi_rate(double t_s) const { return c1 + t_s * (2.0 * c2 + t_s * (3.0 * c3)); }
  Quaternion q_ab(double t_s) const;
  /// rad/s, in b.
  Vector3 omega_ab_b(double t_s) const;
};

/// omega_ab_b of q_ab = q(Phi): Phi' - A Phi x Phi' + B Phi x (Phi x Phi'). Source: P. Savage, Strapdown Analytics,
/// (7.1.1.1), inverted.
Vector3 rate_from_rotation_vector(const RotationFactors& factors, const Vector3& phi, const Vector3& phi_rate);

/// A curve through rotations, whose angular rate and angular acceleration are continuous.
///
/// Between two rotations the rotation vector from the first is a cubic, so the curve passes through every rotation
/// exactly. The rates there are those for which the angular accelerations of neighbours agree: a block tridiagonal
/// system whose quadratic terms are iterated. At both ends the angular acceleration is 0.
/// Source: the equations are derived in docs/models.md; the idea of a cubic rotation vector with iterated quadratic
/// terms is J. McEnnan's (Quaternion cubic spline, 2003).
class RotationSpline {
 public:
  /// `q_ab` at least two rotations, of any sign, at most pi/2 rad from their neighbours or little more; `intervals_s`
  /// the times between them, above 0. Throws std::invalid_argument when these do not fit each other, and
  /// std::domain_error, naming where, when neighbours are so far apart that no smooth rates are found. Time and memory
  /// are linear in the rotations.
  RotationSpline(std::vector<Quaternion> q_ab, std::vector<double> intervals_s);

  std::size_t pieces() const { return intervals_s_.size(); }
  double interval_s(std::size_t piece) const { return intervals_s_[piece]; }

  /// The piece from rotation `index` to the next; its time runs from 0 to interval_s(index).
  RotationPiece piece(std::size_t index) const;

 private:
  std::vector<Quaternion> q_ab_;
  std::vector<double> intervals_s_;
  std::vector<Vector3> omega_ab_b_;
};

}  // namespace inslab::nav
