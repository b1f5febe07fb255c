#pragma once

#include <string>

#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::trajectory {

/// read_trajectory() of a log: the samples of one topic, in the order of their log times.
TrajectoryReading read_trajectory_log(const std::string& path, const TrajectoryReadOptions& options);

}  // namespace inslab::trajectory
