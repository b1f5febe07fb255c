#pragma once

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/files/text_writer.hpp"

namespace inslab::recordings {

/// Writes the 11-column text that read_trajectory() reads: week, seconds of week, latitude deg, longitude deg, height
/// m, v_N v_E v_D m/s, roll pitch yaw deg. Decimals: 9 of seconds, 12 of latitude and longitude (1e-7 m), 6 of height
/// and velocity, 9 of attitude.
class NavTextWriter {
 public:
  /// Throws WriteError.
  explicit NavTextWriter(const std::string& path) : out_(path, " ") {}

  /// `row` has velocity and attitude; its own time is not looked at. Throws WriteError.
  void write(const time::GpsTime& time, const TrajectoryRow& row);

  void close() { out_.close(); }

 private:
  files::TextWriter out_;
};

}  // namespace inslab::recordings
