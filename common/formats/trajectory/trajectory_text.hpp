#pragma once

#include <string>

#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::trajectory {

/// read_trajectory() of a text.
TrajectoryReading read_trajectory_text(const std::string& path, const TrajectoryReadOptions& options);

}  // namespace inslab::trajectory
