#pragma once

#include <string>
#include <vector>

#include "inslab/formats/trajectory/trajectory_repair.hpp"

namespace inslab::check {

/// What a file of rows is to be judged by.
struct TrajectoryCheckOptions {
  std::string file;
  std::string columns;  ///< of a text that does not begin with their names
  std::string topic = trajectory::TrajectoryReadOptions{}.topic;
  std::vector<std::string> limits;  ///< NAME=VALUE, as in a scenario's limits
  std::string repair;               ///< where the repaired rows are written; empty: nowhere
};

/// What it is like, what is wrong with it and what repairing it would take.
struct TrajectoryChecked {
  std::string text;
  bool is_good = false;  ///< of a repair: what was written
};

/// Throws files::ReadError, files::WriteError, json::Error for limits that there are not.
TrajectoryChecked check_trajectory(const TrajectoryCheckOptions& options);

}  // namespace inslab::check
