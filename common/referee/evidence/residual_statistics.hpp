#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::evidence {

/// Spread of an IMU's errors about what a straight line over time and the motion explain: what bias, drift, scale
/// factors, cross axes and g-sensitivity do in a stretch of seconds is taken out by least squares, noise and vibration
/// are left.
class ResidualStatistics {
 public:
  /// An error at a time, with the rate and the specific force that the sensor felt (rad/s, m/s^2).
  void add(double time_s, const Vector3& error, const Vector3& omega, const Vector3& f) {
    Regressors x;
    x << 1.0, time_s, omega, f;
    if (count_ == 0) {
      first_x_ = x;
      first_error_ = error;
    }
    x.tail<kRegressors - 1>() -= first_x_.tail<kRegressors - 1>();
    const Vector3 y = error - first_error_;
    xx_ += x * x.transpose();
    xy_ += x * y.transpose();
    yy_ += y.cwiseAbs2();
    ++count_;
  }

  std::uint64_t count() const { return count_; }

  /// Standard deviation of the residuals, pooled over the axes; needs more samples than there are regressors.
  double pooled_sigma() const;

  static constexpr int kRegressors = 8;

 private:
  using Regressors = Eigen::Matrix<double, kRegressors, 1>;
  using Square = Eigen::Matrix<double, kRegressors, kRegressors>;
  using Cross = Eigen::Matrix<double, kRegressors, 3>;

  Regressors first_x_ = Regressors::Zero();
  Vector3 first_error_ = Vector3::Zero();
  Square xx_ = Square::Zero();
  Cross xy_ = Cross::Zero();
  Vector3 yy_ = Vector3::Zero();
  std::uint64_t count_ = 0;
};

}  // namespace inslab::evidence
