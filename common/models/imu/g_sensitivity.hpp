#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {

/// Stage 3d: gyros have a bias proportional to the specific force along each axis, G in thesis (3-35): the error of
/// interval k is G dv_k, rad.
class GSensitivity {
 public:
  /// The 3x3 matrix row by row, in deg/h/g: row 0 is what forces along x, y, z make of gyro x.
  explicit GSensitivity(const Vector9& deg_per_h_per_g) {
    G_ = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(deg_per_h_per_g.data()) *
         (units::kDegPerH / units::kG);
  }

  bool is_off() const { return G_.isZero(0.0); }

  /// The error of the gyros, rad, from the velocity increment `dv_b` (m/s) that they feel.
  Vector3 error(const Vector3& dv_b) const { return G_ * dv_b; }

 private:
  Matrix3 G_;  ///< rad/s per m/s^2
};

}  // namespace inslab::imu
