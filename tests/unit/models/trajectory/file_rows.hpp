#pragma once

#include <memory>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/nav_state.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/strapdown.hpp"

/// Rows that a motion table gives, as a file would have them.
namespace inslab::trajectory {

inline TrajectoryRow row_of(const TruthState& truth) {
  TrajectoryRow row;
  row.time = time::Nanoseconds(truth.header.sim_time_ns);
  row.position = geodetic_of(truth);
  row.v_n = truth.v_n;
  row.rpy = nav::rpy_from_quaternion(truth.q_nv);
  return row;
}

inline TrajectoryFile rows_of(const scenario::Trajectory& table, double rate_hz, double seconds) {
  MotionTableModel model(table, time::Rate(rate_hz), {2300, 0});
  TrajectoryFile file;
  file.name = "rows.nav";
  file.start = {2300, 0};
  for (file.rows.push_back(row_of(model.current())); time::to_seconds(file.rows.back().time) < seconds;) {
    file.rows.push_back(row_of(model.advance()));
  }
  return file;
}

inline nav::NavState state_of(const TruthState& truth) { return nav_state(truth); }

}  // namespace inslab::trajectory
