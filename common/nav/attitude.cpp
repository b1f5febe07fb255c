#include "inslab/nav/attitude.hpp"

#include <cmath>
#include <stdexcept>

namespace inslab::nav {

namespace {

constexpr double kTwoPi = 2.0 * 3.14159265358979323846;

bool points_backwards(const Quaternion& q) {
  for (const double component : {q.w(), q.x(), q.y(), q.z()}) {
    if (component != 0.0) return component < 0.0;
  }
  return false;
}

/// In [0, 2 pi): a yaw a rounding error below 0 would otherwise come out as 2 pi itself.
double wrapped_to_two_pi(double angle_rad) {
  const double wrapped = angle_rad < 0.0 ? angle_rad + kTwoPi : angle_rad;
  return wrapped < kTwoPi ? wrapped : 0.0;
}

}  // namespace

Matrix3 skew(const Vector3& a) {
  Matrix3 S;
  S << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return S;
}

Quaternion canonical(const Quaternion& q) {
  const double norm = q.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) throw std::domain_error("a quaternion of norm 0 or NaN is no rotation");
  const double factor = points_backwards(q) ? -1.0 / norm : 1.0 / norm;
  return Quaternion(factor * q.w(), factor * q.x(), factor * q.y(), factor * q.z());
}

Quaternion quaternion_from_rpy(const RollPitchYaw& rpy) {
  const double sr = std::sin(0.5 * rpy.roll_rad), cr = std::cos(0.5 * rpy.roll_rad);
  const double sp = std::sin(0.5 * rpy.pitch_rad), cp = std::cos(0.5 * rpy.pitch_rad);
  const double sy = std::sin(0.5 * rpy.yaw_rad), cy = std::cos(0.5 * rpy.yaw_rad);
  return canonical(Quaternion(cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
                              cr * cp * sy - sr * sp * cy));
}

Matrix3 matrix_from_rpy(const RollPitchYaw& rpy) {
  const double sr = std::sin(rpy.roll_rad), cr = std::cos(rpy.roll_rad);
  const double sp = std::sin(rpy.pitch_rad), cp = std::cos(rpy.pitch_rad);
  const double sy = std::sin(rpy.yaw_rad), cy = std::cos(rpy.yaw_rad);
  Matrix3 C_nb;
  C_nb << cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy,  //
      cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy,      //
      -sp, sr * cp, cr * cp;
  return C_nb;
}

RollPitchYaw rpy_from_matrix(const Matrix3& C_nb) {
  const double cos_pitch = std::hypot(C_nb(2, 1), C_nb(2, 2));
  const double pitch = std::atan2(-C_nb(2, 0), cos_pitch);
  if (cos_pitch < kGimbalLockCosine) {
    // With roll 0 the second column is (-sin(yaw), cos(yaw), 0).
    return {0.0, pitch, wrapped_to_two_pi(std::atan2(-C_nb(0, 1), C_nb(1, 1)))};
  }
  // Near the vertical the entries that hold yaw alone vanish, as those of roll do; with the roll taken out, whatever it
  // came out as, the second column is (-sin(yaw), cos(yaw), 0): so both together keep the rotation.
  const double roll = std::atan2(C_nb(2, 1), C_nb(2, 2));
  const double sr = std::sin(roll), cr = std::cos(roll);
  const double yaw = std::atan2(sr * C_nb(0, 2) - cr * C_nb(0, 1), cr * C_nb(1, 1) - sr * C_nb(1, 2));
  return {roll, pitch, wrapped_to_two_pi(yaw)};
}

RollPitchYaw rpy_from_quaternion(const Quaternion& q_nb) { return rpy_from_matrix(matrix_from_quaternion(q_nb)); }

Matrix3 matrix_from_quaternion(const Quaternion& q_nb) { return q_nb.toRotationMatrix(); }

Quaternion quaternion_from_matrix(const Matrix3& C_nb) { return canonical(Quaternion(C_nb)); }

Quaternion quaternion_from_rotation_vector(const Vector3& rotation_vector_rad) {
  const double phi2 = rotation_vector_rad.squaredNorm();
  double w, factor;
  if (phi2 < 1e-4) {
    // Taylor series of cos(phi/2) and sin(phi/2)/phi: the terms left out are below phi^8/1e7 = 1e-23.
    w = 1.0 - phi2 / 8.0 * (1.0 - phi2 / 48.0 * (1.0 - phi2 / 120.0));
    factor = 0.5 - phi2 / 48.0 * (1.0 - phi2 / 80.0 * (1.0 - phi2 / 168.0));
  } else {
    const double phi = std::sqrt(phi2);
    w = std::cos(0.5 * phi);
    factor = std::sin(0.5 * phi) / phi;
  }
  return Quaternion(w, factor * rotation_vector_rad.x(), factor * rotation_vector_rad.y(),
                    factor * rotation_vector_rad.z());
}

Vector3 rotation_vector_from_quaternion(const Quaternion& q) {
  const double sign = points_backwards(q) ? -1.0 : 1.0;
  const double w = sign * q.w();
  const Vector3 v = sign * q.vec();
  const double s = v.norm();
  // For small s, 2 atan2(s, w)/s -> 2/w (1 - (s/w)^2/3): the next term is (s/w)^4/5.
  if (s < 1e-4) return 2.0 / w * (1.0 - s * s / (3.0 * w * w)) * v;
  return 2.0 * std::atan2(s, w) / s * v;
}

double angle_between(const Quaternion& q_a, const Quaternion& q_b) {
  return rotation_vector_from_quaternion(q_a.conjugate() * q_b).norm();
}

}  // namespace inslab::nav
