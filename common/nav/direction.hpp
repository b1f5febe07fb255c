#pragma once

#include <Eigen/Core>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// A vector by its direction.
struct Direction {
  double heading_rad = 0.0;  ///< clockwise from north, 0 to 2 pi
  double pitch_rad = 0.0;    ///< over the horizon
};

inline Direction direction_of(const Vector3& vector_ned_m) {
  const double heading_rad = std::atan2(vector_ned_m.y(), vector_ned_m.x());
  return {heading_rad < 0.0 ? heading_rad + 2.0 * units::kPi : heading_rad,
          std::atan2(-vector_ned_m.z(), std::hypot(vector_ned_m.x(), vector_ned_m.y()))};
}

/// The vector of that direction and length, NED.
inline Vector3 vector_of(const Direction& direction, double length_m) {
  const double level_m = length_m * std::cos(direction.pitch_rad);
  return {level_m * std::cos(direction.heading_rad), level_m * std::sin(direction.heading_rad),
          -length_m * std::sin(direction.pitch_rad)};
}

/// How heading and pitch change with the vector's components, rad/m: the rows of
///
///   d heading = (b_n db_e - b_e db_n) / h^2,   d pitch = (b_d dh - h db_d) / L^2
///
/// with h the level length and L the whole, so that a noise of sigma of the components makes sigma / (L cos pitch) of
/// heading and sigma / L of pitch. Nothing of either where the vector is plumb.
inline Eigen::Matrix<double, 2, 3> by_components(const Vector3& b) {
  const double h2 = b.x() * b.x() + b.y() * b.y();
  const double h = std::sqrt(h2);
  const double l2 = h2 + b.z() * b.z();
  Eigen::Matrix<double, 2, 3> D = Eigen::Matrix<double, 2, 3>::Zero();
  if (h2 > 0.0) {
    D.row(0) << -b.y() / h2, b.x() / h2, 0.0;
    D.row(1) << b.z() * b.x() / (h * l2), b.z() * b.y() / (h * l2), -h / l2;
  }
  return D;
}

}  // namespace inslab::nav
