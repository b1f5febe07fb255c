#include "inslab/models/trajectory/motion_segment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

// Simpson's rule on a vector that turns by 0.02 rad errs by 0.02^4/2880 = 6e-11 of it.
constexpr double kLargestTurnPerStep_rad = 0.02;

/// The profile of one motion in rad/s or m/s^2; none for uniform and ballistic.
std::optional<MotionProfile> profile_of(const scenario::Motion& motion, double duration_s, double speed_m_per_s) {
  using scenario::MotionType;
  using Phase = SinusoidProfile::Phase;
  switch (motion.type) {
    case MotionType::Uniform:
    case MotionType::Ballistic:
      return std::nullopt;
    case MotionType::DeltaSpeed:
      return TrapezoidProfile(motion.speed_change_m_per_s, duration_s, motion.ramp_fraction);
    case MotionType::TargetSpeed:
      return TrapezoidProfile(motion.final_speed_m_per_s - speed_m_per_s, duration_s, motion.ramp_fraction);
    case MotionType::ConstantAccel:
      return ConstantProfile(motion.acceleration_m_per_s2);
    case MotionType::SineAccel:
      return SinusoidProfile(Phase::Sine, motion.amplitude_m_per_s2, motion.period_s);
    case MotionType::RampAccel:
      return RampProfile(motion.from_m_per_s2, motion.to_m_per_s2, duration_s);
    case MotionType::Turn:
      return TurnProfile(motion.angle_deg * units::kDeg, duration_s, motion.ramp_fraction);
    case MotionType::ConstantRate:
      return ConstantProfile(motion.rate_deg_per_s * units::kDeg);
    case MotionType::SineRate:
      return SinusoidProfile(Phase::Sine, motion.amplitude_deg_per_s * units::kDeg, motion.period_s);
    case MotionType::CosineRate:
      return SinusoidProfile(Phase::Cosine, motion.amplitude_deg_per_s * units::kDeg, motion.period_s);
    case MotionType::RampRate:
      return RampProfile(motion.from_deg_per_s * units::kDeg, motion.to_deg_per_s * units::kDeg, duration_s);
  }
  return std::nullopt;
}

}  // namespace

MotionSegment::MotionSegment(const scenario::Segment& segment, const Vector3& v_v)
    : keeps_velocity_on_nose_(segment.keep_velocity_on_nose) {
  const time::Nanoseconds duration = time::from_seconds(segment.duration_s);
  const double duration_s = time::to_seconds(duration);
  double rate_sum = 0.0;
  longest_step_s_ = kNoStepLimit_s;
  for (const scenario::Motion& motion : segment.motions) {
    if (motion.type == scenario::MotionType::Ballistic) {
      drag_per_m_ = motion.drag_per_m;
      spin_ = Spin(motion.spin_deg_per_s * units::kDeg, motion.spin_decay_s);
      ends_at_start_height_ = motion.until_start_height;
    }
    const auto axis = static_cast<Eigen::Index>(scenario::axis_of(motion));
    const std::optional<MotionProfile> profile = profile_of(motion, duration_s, v_v[axis]);
    if (!profile) continue;
    const bool angular = scenario::is_angular(motion.type);
    motions_.push_back({*profile, axis, angular});
    (angular ? turns_ : accelerates_) = true;
    std::visit(
        [&](const auto& p) {
          longest_step_s_ = std::min(longest_step_s_, p.step_s());
          if (angular) rate_sum += p.largest();
          for (const double corner_s : p.corners()) joints_.push_back(time::from_seconds(corner_s));
        },
        *profile);
  }
  if (rate_sum > 0.0) longest_step_s_ = std::min(longest_step_s_, kLargestTurnPerStep_rad / rate_sum);
  joints_.push_back(duration);
  std::sort(joints_.begin(), joints_.end());
  joints_.erase(std::unique(joints_.begin(), joints_.end()), joints_.end());
  if (joints_.front() == time::Nanoseconds(0)) joints_.erase(joints_.begin());
}

MotionSegment MotionSegment::endless() {
  MotionSegment rest;
  rest.longest_step_s_ = kNoStepLimit_s;
  rest.joints_.push_back(time::Nanoseconds::max());
  return rest;
}

MotionInstant MotionSegment::at(double t_s) const {
  MotionInstant instant;
  for (const AxisMotion& motion : motions_) {
    std::visit(
        [&](const auto& profile) {
          (motion.angular ? instant.omega_nv_v : instant.a_lin_v)[motion.axis] += profile.value(t_s);
          (motion.angular ? instant.angle_nv_v : instant.speed_gained_v)[motion.axis] += profile.integral(t_s);
        },
        motion.profile);
  }
  return instant;
}

}  // namespace inslab::trajectory
