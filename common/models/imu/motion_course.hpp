#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::imu {

/// A vector over an interval as a Legendre series in x, -1 to 1.
struct Course {
  Vector3 mean;
  Vector3 slope;
  Vector3 curve;

  /// `jumps`: the value at the end is one after a jump and says nothing of the interval.
  static Course through(const Vector3& start, const Vector3& end, const Vector3& mean, bool jumps) {
    if (jumps) return {mean, mean - start, Vector3::Zero()};
    return {mean, 0.5 * (end - start), 0.5 * (start + end) - mean};
  }
  Vector3 at(double x) const { return mean + x * slope + (1.5 * x * x - 0.5) * curve; }

  /// The same vector between two of its x, as a series of its own: x = middle + half y, y from -1 to 1.
  Course part(double x_from, double x_to) const {
    const double middle = 0.5 * (x_from + x_to), half = 0.5 * (x_to - x_from);
    return {at(middle) + 0.5 * half * half * curve, half * (slope + 3.0 * middle * curve), half * half * curve};
  }
};

/// Truth marks jumps of the rate alone. A jump of the force at the end bends the quadratic by about half of it, where a
/// smooth force bends it far less than it tilts it; a line through the start serves both.
inline bool jumps(const Course& course) { return course.curve.norm() > 0.25 * course.slope.norm(); }

}  // namespace inslab::imu
