#pragma once

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// Z-Y-X Euler angles of C_nb: yaw about z, then pitch about y, then roll about x; thesis (2-6)..(2-15) read as b to n.
struct RollPitchYaw {
  double roll_rad = 0.0;   ///< functions that return one keep it in [-pi, pi]
  double pitch_rad = 0.0;  ///< in [-pi/2, pi/2]
  double yaw_rad = 0.0;    ///< from north towards east, in [0, 2 pi)
};

/// Closer to the vertical than this (cos(pitch) below it) roll and yaw are one angle: roll is then 0 and yaw takes it.
inline constexpr double kGimbalLockCosine = 1e-14;

/// The cross product matrix: skew(a) b = a x b.
Matrix3 skew(const Vector3& a);

/// The same rotation with w >= 0 (with w == 0, the first of x, y, z that is not 0 positive) and norm 1.
/// Throws std::domain_error when the norm is 0 or not finite.
Quaternion canonical(const Quaternion& q);

/// q_nb and C_nb of the angles (any finite values, rad); canonical.
Quaternion quaternion_from_rpy(const RollPitchYaw& rpy);
Matrix3 matrix_from_rpy(const RollPitchYaw& rpy);

/// The angles of C_nb, rad, in the ranges of RollPitchYaw. Together they give the rotation back to rounding, however
/// close to the vertical, where each of roll and yaw alone is uncertain by rounding over cos(pitch).
RollPitchYaw rpy_from_matrix(const Matrix3& C_nb);
RollPitchYaw rpy_from_quaternion(const Quaternion& q_nb);

/// C_nb of the unit quaternion q_nb: thesis (2-16), corrected in docs/models.md.
Matrix3 matrix_from_quaternion(const Quaternion& q_nb);

/// The canonical quaternion of a rotation matrix; thesis (2-17)..(2-22) by the largest of the four components.
Quaternion quaternion_from_matrix(const Matrix3& C_nb);

/// The quaternion (cos(phi/2), sin(phi/2) Phi/phi) of a rotation vector of any length phi, rad: thesis (2-12). Not made
/// canonical, so that it stays continuous in Phi.
Quaternion quaternion_from_rotation_vector(const Vector3& rotation_vector_rad);

/// The shortest rotation vector of a quaternion, rad, of length at most pi: thesis (2-13) with atan2.
Vector3 rotation_vector_from_quaternion(const Quaternion& q);

/// The angle between two attitudes, rad, in [0, pi]; good to rounding near 0.
double angle_between(const Quaternion& q_a, const Quaternion& q_b);

}  // namespace inslab::nav
