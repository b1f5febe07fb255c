#pragma once

#include "inslab/models/trajectory/smooth_motion.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::trajectory {

/// The smooth motion along the waypoints of a trajectory, with the attitude of its vehicle class; a rotation spline
/// goes through attitudes taken from the path. A vehicle at rest at the last waypoint stays there until `end`, the last
/// instant that is asked for: no attitude is taken from what lies far beyond it.
///
/// Nose along the track: the nose follows the line, at rest too; yaw stays as it is where the line is vertical; the
/// vehicle banks as it turns; attitudes are 2 deg and 10 s apart at most. The other classes: attitudes so near that
/// half-way and at the quarters the arc between two leaves the class's own by at most 2e-5 rad, and 1 s apart at most.
/// `gravity` is what the thrust of a multirotor and the wings of an aircraft bear.
///
/// Throws std::invalid_argument, naming the JSON path, when the waypoints break a rule, and std::domain_error, naming
/// time and waypoint, where the nose would have to jump.
SmoothMotion motion_along_waypoints(const scenario::Trajectory& trajectory, time::Nanoseconds end,
                                    const nav::Gravity& gravity = nav::Gravity());

}  // namespace inslab::trajectory
