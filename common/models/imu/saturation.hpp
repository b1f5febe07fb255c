#pragma once

#include <limits>

#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 5b: an axis puts out at most its full scale, as the mean over the interval.
class Saturation {
 public:
  Saturation(const TriadParameters& parameters, double dt_s) {
    for (int axis = 0; axis < 3; ++axis) {
      const double full_scale = parameters.full_scale[axis];
      largest_[axis] = full_scale == 0.0 ? std::numeric_limits<double>::infinity() : full_scale * dt_s;
    }
    is_off_ = parameters.full_scale.isZero(0.0);
  }

  bool is_off() const { return is_off_; }

  struct Result {
    Vector3 increment;       ///< rad | m/s
    bool saturated = false;  ///< an axis was cut
  };
  Result limited(const Vector3& increment) const {
    return {increment.cwiseMin(largest_).cwiseMax(-largest_), (increment.array().abs() > largest_.array()).any()};
  }

 private:
  Vector3 largest_;  ///< rad | m/s
  bool is_off_ = true;
};

}  // namespace inslab::imu
