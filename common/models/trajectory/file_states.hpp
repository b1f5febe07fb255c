#pragma once

#include <memory>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/nav/strapdown.hpp"

namespace inslab::trajectory {

/// The states that the rows of a file describe, at any time between its first and its last row; rows may be irregular.
///
/// At a row it is that row. Between two the velocity is linear in time, the attitude turns about one axis at one rate,
/// and the position is the integral of the velocity plus, linear in time, what the rows' positions say beyond it.
class FileStates {
 public:
  /// Each row of `file` has velocity and attitude. Throws std::invalid_argument, naming the file, where one has not, or
  /// when there are fewer than two rows.
  explicit FileStates(std::shared_ptr<const TrajectoryFile> file);

  /// The state at `t`, which does not decrease from call to call. Throws std::domain_error, naming the file and both
  /// times, when `t` lies outside the rows.
  nav::NavState at(time::Nanoseconds t);

  time::Nanoseconds end() const { return file_->rows.back().time; }

 private:
  std::shared_ptr<const TrajectoryFile> file_;
  std::size_t row_ = 0;  ///< the last one not after the time asked for
};

}  // namespace inslab::trajectory
