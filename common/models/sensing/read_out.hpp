#pragma once

#include <cmath>

#include "inslab/foundation/fields/field.hpp"

/// What lies between a quantity and the number that an instrument shows for it.
namespace inslab::sensing {

/// `value` in whole counts, the nearest; as it is where the count is 0.
inline double quantized(double value, double count) {
  return count > 0.0 ? std::nearbyint(value / count) * count : value;
}
inline Vector3 quantized(const Vector3& value, const Vector3& count) {
  return {quantized(value.x(), count.x()), quantized(value.y(), count.y()), quantized(value.z(), count.z())};
}

/// Cuts `value` at the ends of a range, and says whether it was beyond one.
inline bool cut(double& value, double least, double most) {
  if (value < least) {
    value = least;
  } else if (value > most) {
    value = most;
  } else {
    return false;
  }
  return true;
}

/// Cuts each axis at its full scale, either way, 0 being none, and says whether one was beyond it.
inline bool cut(Vector3& value, const Vector3& full_scale) {
  bool is_cut = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (full_scale[axis] > 0.0) is_cut = cut(value[axis], -full_scale[axis], full_scale[axis]) || is_cut;
  }
  return is_cut;
}

}  // namespace inslab::sensing
