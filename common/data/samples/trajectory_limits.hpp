#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {

/// What a trajectory file is held to. A value that a file breaks is an error that names line and column; raising the
/// limit in the open is the way to use the file as it is, `inslab trajectory check FILE --repair` the other.
struct TrajectoryLimits {
  double max_gap_s = 2.0;
  double max_velocity_mismatch_m_per_s = 0.5;
  double max_position_step_m = 0.2;
  double max_acceleration_m_per_s2 = 150.0;
  double max_rate_deg_per_s = 500.0;
  double max_off_track_deg = 180.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("max_gap_s", "time between two rows").in(1e-6, 1e6), self.max_gap_s);
    visit(Field("max_velocity_mismatch_m_per_s",
                "mean velocity by the positions less that by the velocities, over a second or from row to row")
              .in(0.0, 1e4),
          self.max_velocity_mismatch_m_per_s);
    visit(Field("max_position_step_m",
                "what a position may step from row to row beyond the velocities and their permitted mismatch")
              .in(0.0, 1e6),
          self.max_position_step_m);
    visit(Field("max_acceleration_m_per_s2",
                "change of velocity from row to row over the time; without velocities that of the positions' own")
              .in(0.0, 1e6),
          self.max_acceleration_m_per_s2);
    visit(Field("max_rate_deg_per_s", "change of attitude from row to row over the time").in(0.0, 1e6),
          self.max_rate_deg_per_s);
    visit(Field("max_off_track_deg", "between the nose and the velocity, faster than 2 m/s; 180: not judged")
              .in(0.0, 180.0),
          self.max_off_track_deg);
  }
};

}  // namespace inslab
