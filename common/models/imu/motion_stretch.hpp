#pragma once

#include <algorithm>
#include <cstdint>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/motion_course.hpp"

namespace inslab::imu {

/// What a triad feels over a stretch of sim time: a quadratic of its rate, rad/s | m/s^2, and at the stretch's end an
/// impulse, rad | m/s.
struct MotionStretch {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  Course course{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  Vector3 impulse = Vector3::Zero();

  double length_s() const { return time::to_seconds(to_ns - from_ns); }
  Vector3 integral() const { return course.mean * length_s() + impulse; }

  /// The part of it in (begin_ns, end_ns], which it overlaps; the impulse is of the part that has the end.
  MotionStretch part(std::int64_t begin_ns, std::int64_t end_ns) const {
    if (begin_ns <= from_ns && end_ns >= to_ns) return *this;
    const std::int64_t part_from_ns = std::max(begin_ns, from_ns), part_to_ns = std::min(end_ns, to_ns);
    const double half_per_ns = 2.0 / static_cast<double>(to_ns - from_ns);
    const double x_from = half_per_ns * static_cast<double>(part_from_ns - from_ns) - 1.0;
    const double x_to = half_per_ns * static_cast<double>(part_to_ns - from_ns) - 1.0;
    return {part_from_ns, part_to_ns, course.part(x_from, x_to),
            part_to_ns == to_ns ? impulse : Vector3(Vector3::Zero())};
  }

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.from_ns, self.to_ns, self.course.mean, self.course.slope, self.course.curve, self.impulse);
  }
};

}  // namespace inslab::imu
