#pragma once

#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 3b: what a straight line cannot be fitted to. For a mean input x of the interval (rad/s | m/s^2)
///
///   error = a/2 |x| + n F (x/F)^3 + q x^2
///
/// a: asymmetry, the scale factor of positive inputs less that of negative ones (IEEE Std 528); n: departure from the
/// line at full scale F; q: growth of the scale factor with the input (for accelerometers 1 ppm/g is K2 = 1 ug/g^2 of
/// IEEE Std 1293). The interval's mean input stands for the input: what a vibration that is fast against the sample
/// rate would be rectified to is not in it.
class Nonlinearity {
 public:
  explicit Nonlinearity(const TriadParameters& parameters)
      : half_asymmetry_(0.5 * parameters.scale_factor_asymmetry), square_(parameters.nonlinearity_by_input) {
    for (int axis = 0; axis < 3; ++axis) {
      const double of_full_scale = parameters.nonlinearity_of_full_scale[axis];
      const double full_scale = parameters.full_scale[axis];
      cube_[axis] = of_full_scale == 0.0 ? 0.0 : of_full_scale / (full_scale * full_scale);
    }
    is_off_ = half_asymmetry_.isZero(0.0) && square_.isZero(0.0) && cube_.isZero(0.0);
  }

  bool is_off() const { return is_off_; }

  /// The error of an increment over `dt_s`, in its unit.
  Vector3 error(const Vector3& sensed, double dt_s) const {
    const Eigen::Array3d x = sensed.array() / dt_s;
    const Eigen::Array3d error = half_asymmetry_.array() * x.abs() + (square_.array() + cube_.array() * x) * x * x;
    return dt_s * error.matrix();
  }

 private:
  Vector3 half_asymmetry_;
  Vector3 square_;                  ///< per unit of input
  Vector3 cube_ = Vector3::Zero();  ///< per unit of input squared
  bool is_off_ = true;
};

}  // namespace inslab::imu
