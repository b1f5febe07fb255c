#pragma once

#include <optional>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/trajectory/motion_profiles.hpp"
#include "inslab/models/trajectory/spin.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::trajectory {

/// What a segment asks of the vehicle at one time, in v axes.
struct MotionInstant {
  Vector3 omega_nv_v = Vector3::Zero();      ///< rad/s
  Vector3 angle_nv_v = Vector3::Zero();      ///< rad, integral of omega_nv_v from the segment's start
  Vector3 a_lin_v = Vector3::Zero();         ///< m/s^2
  Vector3 speed_gained_v = Vector3::Zero();  ///< m/s, integral of a_lin_v from the segment's start
};

/// One segment of the motion table as continuous functions of the time since its start: math of thesis 3.2.1 and
/// table 3-1. The sums of all its motions, axis by axis.
class MotionSegment {
 public:
  /// `v_v` is the vehicle's velocity at the segment's start, in v axes, m/s: a target speed begins there.
  MotionSegment(const scenario::Segment& segment, const Vector3& v_v);

  /// Rest or constant velocity without an end: what follows the last segment.
  static MotionSegment endless();

  /// What an angular or linear motion asks; nothing of a ballistic segment, where gravity does.
  MotionInstant at(double t_s) const;

  /// Where integration has to be split, in increasing order: the corners inside, then the end.
  const std::vector<time::Nanoseconds>& joints() const { return joints_; }
  time::Nanoseconds duration() const { return joints_.back(); }

  /// A ballistic segment that ends before its duration, after `duration` > 0.
  void end_after(time::Nanoseconds duration) { joints_ = {duration}; }

  /// The longest step that resolves the motion; infinity for one without turns and sinusoids.
  double longest_step_s() const { return longest_step_s_; }
  bool turns() const { return turns_; }
  bool accelerates() const { return accelerates_; }
  bool keeps_velocity_on_nose() const { return keeps_velocity_on_nose_; }

  /// Deceleration over speed squared of a ballistic segment, 1/m; of other segments nothing.
  const std::optional<double>& drag_per_m() const { return drag_per_m_; }
  /// About the velocity, in a ballistic segment.
  const Spin& spin() const { return spin_; }
  bool is_ballistic() const { return drag_per_m_.has_value(); }
  bool ends_at_start_height() const { return ends_at_start_height_; }

 private:
  struct AxisMotion {
    MotionProfile profile;
    Eigen::Index axis;
    bool angular;
  };

  MotionSegment() = default;

  std::vector<AxisMotion> motions_;
  std::vector<time::Nanoseconds> joints_;
  double longest_step_s_ = 0.0;
  bool turns_ = false;
  bool accelerates_ = false;
  bool keeps_velocity_on_nose_ = true;
  std::optional<double> drag_per_m_;
  Spin spin_;
  bool ends_at_start_height_ = false;
};

}  // namespace inslab::trajectory
