#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {

/// Products of different components, in the order y z, z x, x y.
inline Vector3 cross_products(const Vector3& x) { return {x.y() * x.z(), x.z() * x.x(), x.x() * x.y()}; }

/// Stage 3d, too: biases of gyros by second powers of the specific force f and of the angular rate omega,
///
///   A (f_x^2, f_y^2, f_z^2) + B (f_y f_z, f_z f_x, f_x f_y)    g^2-sensitivity and anisoelasticity
///   C (omega_y omega_z, omega_z omega_x, omega_x omega_y)      anisoinertia
///
/// (Titterton and Weston, "Strapdown Inertial Navigation Technology", 2nd edition, 2004, chapters 4 and 8). Of the
/// force the means over an interval are its mean's and what a vibration within the interval adds (Vibration::moments);
/// of the rate they are the mean's.
class SecondOrderDrift {
 public:
  /// The 3x3 matrices row by row, deg/h/g^2 and deg/h/(deg/s)^2; a row is a gyro.
  SecondOrderDrift(const Vector9& squares, const Vector9& products, const Vector9& rate_products)
      : A_(matrix(squares) * (units::kDegPerH / kG2)),
        B_(matrix(products) * (units::kDegPerH / kG2)),
        C_(matrix(rate_products) * (units::kDegPerH / (units::kDegPerS * units::kDegPerS))),
        is_of_force_(!A_.isZero(0.0) || !B_.isZero(0.0)),
        is_of_rate_(!C_.isZero(0.0)) {}

  bool is_of_force() const { return is_of_force_; }
  bool is_of_rate() const { return is_of_rate_; }

  /// The error of an interval of `dt_s`, rad, from what is felt of the force, m/s, and the moments within, (m/s^2)^2.
  Vector3 of_force(const Vector3& dv, const Matrix3& moments, double dt_s) const {
    const Vector3 f = dv / dt_s;
    const Vector3 products(moments(1, 2), moments(2, 0), moments(0, 1));
    return dt_s * (A_ * (f.cwiseAbs2() + moments.diagonal()) + B_ * (cross_products(f) + products));
  }
  /// The same from what is felt of the rate, rad.
  Vector3 of_rate(const Vector3& dtheta, double dt_s) const { return dt_s * (C_ * cross_products(dtheta / dt_s)); }

 private:
  static constexpr double kG2 = units::kG * units::kG;
  static Matrix3 matrix(const Vector9& rows) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  }

  Matrix3 A_;  ///< rad/s per (m/s^2)^2
  Matrix3 B_;
  Matrix3 C_;  ///< rad/s per (rad/s)^2
  bool is_of_force_;
  bool is_of_rate_;
};

}  // namespace inslab::imu
