#pragma once

#include <cmath>

#include "inslab/models/satellites/satellite_state.hpp"

namespace inslab::satellites {

/// Rotations of coordinates about the first and the third axis, as the ICDs write R_X and R_Z.
inline Matrix3 rotation_x(double angle_rad) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  return (Matrix3() << 1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c).finished();
}
inline Matrix3 rotation_z(double angle_rad) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  return (Matrix3() << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0).finished();
}

/// How an orbit lies: longitude of its node, inclination, argument of its perigee.
struct OrbitPlane {
  double node_rad;
  double inclination_rad;
  double perigee_rad;

  /// Takes the orbit's own axes (perigee, 90 deg on, pole) to those that it lies in.
  Matrix3 rotation() const { return rotation_z(-node_rad) * rotation_x(-inclination_rad) * rotation_z(-perigee_rad); }

  /// Undoes rotation(); without an inclination the node is at the first axis.
  static OrbitPlane of(const Matrix3& R) {
    return {std::atan2(R(0, 2), -R(1, 2)), std::atan2(std::hypot(R(2, 0), R(2, 1)), R(2, 2)),
            std::atan2(R(2, 0), R(2, 1))};
  }
};

}  // namespace inslab::satellites
