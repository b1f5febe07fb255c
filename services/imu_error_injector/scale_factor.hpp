#pragma once

#include "samples/field.hpp"

namespace inslab::imu {

/// Stage 3a: each axis reads its own input too large by its scale factor error: S in thesis (3-35), (3-36).
class ScaleFactor {
 public:
  /// `scale_factor` per axis, as a fraction (1e-6 for a ppm).
  explicit ScaleFactor(const Vector3& scale_factor) : scale_factor_(scale_factor) {}

  /// The error of an increment, in its unit.
  Vector3 error(const Vector3& sensed) const { return scale_factor_.cwiseProduct(sensed); }

 private:
  Vector3 scale_factor_;
};

}  // namespace inslab::imu
