#pragma once

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"
#include "inslab/scenario/attitude_from_path.hpp"

namespace inslab::trajectory {

/// The smooth motion through the rows of a file: a position spline over time and a rotation spline, both through every
/// row. Velocities of the file are used at its two ends alone, where a spline is free to choose one. A file without
/// attitudes gets those of its path (attitudes_along), row by row.
///
/// Throws std::invalid_argument when the file has fewer than two rows, and std::domain_error, naming the file and
/// where, when its attitudes turn too far from row to row or a position lies outside the valid domain.
SmoothMotion motion_through(const TrajectoryFile& file, const scenario::PathAttitude& path_attitude);

}  // namespace inslab::trajectory
