#include "inslab/scenario/trajectory.hpp"

#include <sstream>

#include "inslab/scenario/waypoint_route.hpp"

namespace inslab::scenario {

namespace {

std::string path_of_motion(std::size_t segment, std::size_t motion) {
  return "segments[" + std::to_string(segment) + "].motions[" + std::to_string(motion) + "]";
}

/// A speed can be promised only when nothing else accelerates along the same axis.
std::optional<Violation> target_speed_violation(const Segment& segment, std::size_t segment_index) {
  for (std::size_t i = 0; i < segment.motions.size(); ++i) {
    if (segment.motions[i].type != MotionType::TargetSpeed) continue;
    for (std::size_t j = 0; j < segment.motions.size(); ++j) {
      const Motion& other = segment.motions[j];
      if (j == i || is_angular(other.type) || other.type == MotionType::Uniform) continue;
      if (axis_of(other) == axis_of(segment.motions[i])) {
        return Violation{Rule::TargetSpeedAlone, path_of_motion(segment_index, j) + ".axis",
                         "another motion of this segment holds a target speed along the same axis"};
      }
    }
    if (segment.keep_velocity_on_nose) continue;
    for (std::size_t j = 0; j < segment.motions.size(); ++j) {
      if (is_angular(segment.motions[j].type)) {
        return Violation{Rule::TargetSpeedOnNose, path_of_motion(segment_index, j) + ".type",
                         "turns the axis of a target speed while keep_velocity_on_nose is false"};
      }
    }
  }
  return std::nullopt;
}

/// Attitude and velocity of a ballistic segment are gravity's alone.
std::optional<Violation> ballistic_violation(const Segment& segment, std::size_t segment_index) {
  for (std::size_t i = 0; i < segment.motions.size(); ++i) {
    if (segment.motions[i].type != MotionType::Ballistic) continue;
    if (segment.motions.size() > 1) {
      return Violation{Rule::BallisticAlone, path_of_motion(segment_index, i) + ".type",
                       "is ballistic beside another motion; expected it alone in its segment"};
    }
    if (!segment.keep_velocity_on_nose) {
      return Violation{Rule::BallisticAlone, "segments[" + std::to_string(segment_index) + "].keep_velocity_on_nose",
                       "is false; the attitude of a ballistic segment follows the velocity"};
    }
  }
  return std::nullopt;
}

std::optional<Violation> yaw_violation(const Trajectory& trajectory) {
  if (trajectory.attitude_from_path.vehicle_class == VehicleClass::Multirotor) return std::nullopt;
  for (std::size_t k = 0; k < trajectory.waypoints.size(); ++k) {
    if (!trajectory.waypoints[k].yaw_deg) continue;
    return Violation{Rule::WaypointYaw, "waypoints[" + std::to_string(k) + "].yaw_deg",
                     "is set for a vehicle whose nose follows the path; expected attitude_from_path.vehicle_class "
                     "multirotor, or no yaw"};
  }
  return std::nullopt;
}

/// A path that leans a multirotor further than it can.
std::optional<Violation> tilt_violation(const Trajectory& trajectory) {
  const VehicleAttitude& attitude = trajectory.attitude_from_path;
  if (attitude.vehicle_class != VehicleClass::Multirotor) return std::nullopt;
  const WaypointRoute route(trajectory.waypoints, route_options(trajectory));
  for (std::size_t i = 0; i < route.pieces(); ++i) {
    const PathPiece piece = route.piece(i);
    const auto excess = excess_tilt(piece, attitude);
    if (!excess) continue;
    std::ostringstream why;
    why.precision(4);
    why << "leads into a tilt of " << excess->tilt_deg << " deg at " << excess->at_s << " s; expected at most "
        << attitude.max_tilt_deg
        << " (attitude_from_path.max_tilt_deg): a lower speed, a wider bend or less leg_acceleration_m_per_s2";
    return Violation{Rule::WaypointTilt, "waypoints[" + std::to_string(piece.index) + "]", why.str()};
  }
  return std::nullopt;
}

}  // namespace

RouteOptions route_options(const Trajectory& trajectory) {
  return {trajectory.leg_acceleration_m_per_s2,
          trajectory.attitude_from_path.vehicle_class == VehicleClass::Multirotor};
}

bool is_angular(MotionType type) {
  switch (type) {
    case MotionType::Turn:
    case MotionType::ConstantRate:
    case MotionType::SineRate:
    case MotionType::CosineRate:
    case MotionType::RampRate:
      return true;
    default:
      return false;
  }
}

Axis axis_of(const Motion& motion) { return motion.axis.value_or(is_angular(motion.type) ? Axis::Z : Axis::X); }

std::optional<Violation> violation(const Trajectory& trajectory) {
  if (!trajectory.segments.empty() && !trajectory.segments_file.empty()) {
    return Violation{Rule::SegmentsOnce, "segments_file", "is given beside segments; expected one of the two"};
  }
  if (trajectory.source == TrajectorySource::File) {
    if (auto broken = violation(trajectory.file.attitude_from_path)) {
      return Violation{broken->rule, "file.attitude_from_path." + broken->path, broken->reason};
    }
  }
  if (trajectory.source == TrajectorySource::Waypoints) {
    if (auto broken = violation(trajectory.attitude_from_path)) {
      return Violation{broken->rule, "attitude_from_path." + broken->path, broken->reason};
    }
    if (auto broken = yaw_violation(trajectory)) return broken;
    if (auto broken =
            violation(trajectory.waypoints, trajectory.max_acceleration_m_per_s2, route_options(trajectory))) {
      return broken;
    }
    return tilt_violation(trajectory);
  }
  if (trajectory.source == TrajectorySource::VehicleState) {
    if (auto broken = violation(trajectory.vehicle)) {
      return Violation{broken->rule, "vehicle." + broken->path, broken->reason};
    }
  }
  for (std::size_t i = 0; i < trajectory.segments.size(); ++i) {
    if (auto broken = ballistic_violation(trajectory.segments[i], i)) return broken;
    if (auto broken = target_speed_violation(trajectory.segments[i], i)) return broken;
  }
  double total_s = 0.0;
  for (std::size_t i = 0; i < trajectory.segments.size(); ++i) {
    total_s += trajectory.segments[i].duration_s;
    if (!(total_s <= kMaxTrajectoryLength_s)) {
      return Violation{Rule::TrajectoryLength, "segments[" + std::to_string(i) + "].duration_s",
                       "brings the segments' total above 1e9 s"};
    }
  }
  return std::nullopt;
}

}  // namespace inslab::scenario
