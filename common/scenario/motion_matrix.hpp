#pragma once

#include <filesystem>
#include <vector>

#include "inslab/scenario/trajectory.hpp"

namespace inslab::scenario {

/// Reads the thesis's trajectory matrix (section 3.2.1): one segment a line, four numbers separated by commas.
///
///   # type, duration s, ...
///   1,  60,  0,   0      uniform
///   3,  10, 15,   0      target speed m/s
///   7,   8,  0,  90      turn deg, in the fourth column
///   5,  20,  0.4, 5      sine acceleration: amplitude m/s^2, period s
///   9,  20,  5,   2      sine rate: period s, amplitude deg/s, the other way round
///
/// Columns that a type does not use are 0. Accelerations act along x_v, rates about z_v, ramps take a quarter of the
/// duration. Blank lines and lines that begin with # are skipped. Throws json::Error naming file and line.
std::vector<Segment> read_motion_matrix(const std::filesystem::path& file);

}  // namespace inslab::scenario
