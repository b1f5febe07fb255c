#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::imu {

/// Stage 3c: each axis reads a part of its neighbours' inputs: N in thesis (3-35), (3-36).
///
/// The six small angles are ordered x to y, x to z, y to x, y to z, z to x, z to y. "x to y" is the angle by which the
/// sensitive axis y leans towards x: an input on x shows on output y times that angle.
///
///       |   0    y_x   z_x |
///   N = |  x_y    0    z_y |     (columns: the input, rows: the output it shows on)
///       |  x_z   y_z    0  |
class CrossAxis {
 public:
  explicit CrossAxis(const Vector6& angles_rad) {
    const double x_y = angles_rad[0], x_z = angles_rad[1], y_x = angles_rad[2];
    const double y_z = angles_rad[3], z_x = angles_rad[4], z_y = angles_rad[5];
    N_ << 0.0, y_x, z_x,  //
        x_y, 0.0, z_y,    //
        x_z, y_z, 0.0;
  }

  bool is_off() const { return N_.isZero(0.0); }

  /// The error of an increment, in its unit.
  Vector3 error(const Vector3& sensed) const { return N_ * sensed; }

 private:
  Matrix3 N_;
};

}  // namespace inslab::imu
