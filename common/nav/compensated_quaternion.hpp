#pragma once

#include <array>

#include "inslab/nav/compensated_sum.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// A unit quaternion that is turned a little, millions of times: its roundings do not add up. Each turn is added as the
/// small change it makes, to compensated sums, and the norm is brought back to 1 after thesis (2-57).
class CompensatedQuaternion {
 public:
  /// `q` is a unit quaternion.
  explicit CompensatedQuaternion(const Quaternion& q);

  /// q <- q * rotation, the rotation vector in rad in the axes that q takes from.
  void turn_source(const Vector3& rotation_vector_rad);

  /// q <- rotation * q, the rotation vector in rad in the axes that q takes to.
  void turn_target(const Vector3& rotation_vector_rad);

  /// Of norm 1 to rounding; its sign is the start's, carried along.
  Quaternion value() const;

 private:
  void add_turn(const Vector3& rotation_vector_rad, double side);

  std::array<CompensatedSum, 4> wxyz_;
};

}  // namespace inslab::nav
