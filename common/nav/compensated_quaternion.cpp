#include "inslab/nav/compensated_quaternion.hpp"

#include "inslab/nav/attitude.hpp"

namespace inslab::nav {

CompensatedQuaternion::CompensatedQuaternion(const Quaternion& q)
    : wxyz_{CompensatedSum(q.w()), CompensatedSum(q.x()), CompensatedSum(q.y()), CompensatedSum(q.z())} {}

void CompensatedQuaternion::turn_source(const Vector3& rotation_vector_rad) { add_turn(rotation_vector_rad, 1.0); }

void CompensatedQuaternion::turn_target(const Vector3& rotation_vector_rad) { add_turn(rotation_vector_rad, -1.0); }

/// The two products differ in the sign of their cross product.
void CompensatedQuaternion::add_turn(const Vector3& rotation_vector_rad, double side) {
  // The change of q is formed, not the new q: its rounding is that of a small number, and the sums keep it.
  const Quaternion half = quaternion_from_rotation_vector(0.5 * rotation_vector_rad);
  const double dw = -2.0 * half.vec().squaredNorm();  // cos(phi/2) - 1
  const Vector3 dvec = 2.0 * half.w() * half.vec();
  const Quaternion q = value();
  const Vector3 vec_change = dw * q.vec() + q.w() * dvec + side * q.vec().cross(dvec);
  wxyz_[0].add(dw * q.w() - q.vec().dot(dvec));
  for (int i = 0; i < 3; ++i) wxyz_[i + 1].add(vec_change[i]);

  const double correction = 0.5 * (1.0 - value().squaredNorm());
  for (CompensatedSum& component : wxyz_) component.add(correction * component.value());
}

Quaternion CompensatedQuaternion::value() const {
  return Quaternion(wxyz_[0].value(), wxyz_[1].value(), wxyz_[2].value(), wxyz_[3].value());
}

}  // namespace inslab::nav
