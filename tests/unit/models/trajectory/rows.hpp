#pragma once

#include <cmath>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"

/// Trajectory files made from motion tables.
namespace inslab::trajectory::rows {

/// What a file would say of a motion table at `rate_hz`, with all digits, from the start to `seconds`.
inline TrajectoryFile of_table(const scenario::Trajectory& table, double rate_hz, double seconds) {
  TrajectoryFile file;
  file.name = "rows";
  MotionTableModel model(table, time::Rate(rate_hz), {2300, 0});
  for (long i = std::lround(seconds * rate_hz); i >= 0; --i) {
    const TruthState truth = model.current();
    file.rows.push_back({time::Nanoseconds(truth.header.sim_time_ns), geodetic_of(truth), truth.v_n,
                         nav::rpy_from_quaternion(truth.q_nv)});
    if (i > 0) model.advance();
  }
  return file;
}

/// The same without velocities and attitudes.
inline TrajectoryFile positions_of(TrajectoryFile file) {
  for (TrajectoryRow& row : file.rows) {
    row.v_n.reset();
    row.rpy.reset();
  }
  return file;
}

}  // namespace inslab::trajectory::rows
