#pragma once

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/scenario/vehicle_class.hpp"

namespace inslab::trajectory {

/// The smooth motion through the rows of a file: a position spline over time and a rotation spline. Velocities of the
/// file are used at its two ends alone, where a spline is free to choose one.
///
/// Attitudes of the file are passed through, row by row. A file without them gets those of its vehicle's class: with
/// the nose along the track those of its path (attitudes_along), row by row; of another class as along waypoints, so
/// near to each other as its law needs (ClassAttitude), and a ship heaves. `gravity` is what thrust and wings bear.
///
/// Throws std::invalid_argument when the file has fewer than two rows, and std::domain_error, naming the file and
/// where, when its attitudes turn too far from row to row, the nose would have to jump, a multirotor would tilt further
/// than it can, or a position lies outside the valid domain.
SmoothMotion motion_through(const TrajectoryFile& file, const scenario::VehicleAttitude& attitude,
                            const nav::Gravity& gravity = nav::Gravity());

}  // namespace inslab::trajectory
