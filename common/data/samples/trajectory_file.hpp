#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab {

/// One row of a trajectory file: where the vehicle is and, as far as the file knows, how fast and which way.
struct TrajectoryRow {
  time::Nanoseconds time{0};  ///< since the first row; increases
  nav::Geodetic position;
  std::optional<nav::Vector3> v_n;       ///< m/s, relative to the Earth, NED
  std::optional<nav::RollPitchYaw> rpy;  ///< of C_nv
};

/// The rows of a discrete trajectory with the instant of the first one. Either all rows have a velocity or none has;
/// attitude likewise.
struct TrajectoryFile {
  std::string name;  ///< for messages
  time::GpsTime start;
  std::vector<TrajectoryRow> rows;
};

}  // namespace inslab
