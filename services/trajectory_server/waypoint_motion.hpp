#pragma once

#include "scenario/trajectory.hpp"
#include "services/trajectory_server/smooth_motion.hpp"

namespace inslab::trajectory {

/// The smooth motion along the waypoints of a trajectory. The nose follows the line, at rest too; yaw stays as it is
/// where the line is vertical; the vehicle banks as it turns. Attitudes are taken from the path 2 deg and 10 s apart at
/// most, and a rotation spline goes through them. A vehicle at rest at the last waypoint stays there until `end`.
///
/// Throws std::invalid_argument, naming the JSON path, when the waypoints break a rule.
SmoothMotion motion_along_waypoints(const scenario::Trajectory& trajectory, time::Nanoseconds end);

}  // namespace inslab::trajectory
