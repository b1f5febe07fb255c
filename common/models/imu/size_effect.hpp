#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/models/imu/motion_course.hpp"

namespace inslab::imu {

/// Stage 2a: the accelerometers of a triad sit at places r_i of their own, from the point that is taken for the IMU's,
/// and accelerometer i feels along its axis e_i
///
///   e_i . (alpha x r_i + omega x (omega x r_i)),   omega = omega_ib_b, alpha = omega'
///
/// more (the size effect: Savage, "Strapdown Inertial Navigation Integration Algorithm Design Part 2", 1998). The first
/// part's integral is the change of the rate exactly, jumps included; the second's is that of the square of a
/// quadratic, as in Installation.
class SizeEffect {
 public:
  /// The 3x3 matrix row by row, m: row i is r_i in b.
  explicit SizeEffect(const Vector9& place_m)
      : place_m_(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(place_m.data())) {
    // alpha x r_i along e_i, as a matrix that takes alpha.
    of_alpha_ << 0.0, place_m_(0, 2), -place_m_(0, 1),  //
        -place_m_(1, 2), 0.0, place_m_(1, 0),           //
        place_m_(2, 1), -place_m_(2, 0), 0.0;
  }

  bool is_off() const { return place_m_.isZero(0.0); }

  /// Of an angular acceleration, m/s^2; of a change of the rate, m/s.
  Vector3 of_alpha(const Vector3& alpha) const { return of_alpha_ * alpha; }

  /// Of a rate, m/s^2: along e_i of omega (omega . r_i) - r_i omega^2.
  Vector3 of_rate(const Vector3& omega) const {
    return omega.cwiseProduct(place_m_ * omega) - omega.squaredNorm() * place_m_.diagonal();
  }

  /// The integral over `dt_s` in which the rate is `omega` and jumps by `jump` at the end, m/s. Products of different
  /// Legendre polynomials average to 0, P1^2 to 1/3, P2^2 to 1/5.
  Vector3 increment(const Course& omega, const Vector3& jump, double dt_s) const {
    return of_alpha(2.0 * omega.slope + jump) +
           dt_s * (of_rate(omega.mean) + of_rate(omega.slope) / 3.0 + of_rate(omega.curve) / 5.0);
  }

 private:
  Matrix3 place_m_;
  Matrix3 of_alpha_;
};

}  // namespace inslab::imu
