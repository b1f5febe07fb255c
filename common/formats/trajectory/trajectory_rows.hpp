#pragma once

#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::trajectory {

/// Adds rows to a reading in the order of the file: takes care of the first one's GPS time and of time that does not
/// increase.
class TrajectoryRows {
 public:
  explicit TrajectoryRows(TrajectoryReading& reading) : reading_(&reading) {}

  /// `time` counts from the same zero in all rows; of the first one it becomes `start`. `row.time` is set here. Adds a
  /// problem instead when time does not increase, or when there are more rows than a file may have.
  void add(std::uint64_t line, time::Nanoseconds time, const time::GpsTime& start, TrajectoryRow row);

  /// A row came that is one too many: nothing further is read.
  bool is_full() const { return is_full_; }

 private:
  TrajectoryReading* reading_;
  bool is_full_ = false;
  time::Nanoseconds first_{0};
};

}  // namespace inslab::trajectory
