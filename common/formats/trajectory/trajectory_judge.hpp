#pragma once

#include <optional>

#include "inslab/data/samples/trajectory_limits.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::trajectory {

/// The largest value of something, and the row at whose end it stands.
struct Worst {
  double value = 0.0;
  std::size_t row = 0;
};

/// A place where a limit is broken: the column and the row at whose end it stands.
struct TrajectoryFault {
  Rule rule;
  Quantity at;
  std::size_t row;
};

/// What a trajectory is like, measured row by row.
struct TrajectoryFigures {
  double shortest_interval_s = 0.0;
  Worst longest_interval_s;
  double fastest_m_per_s = 0.0;     ///< by the velocities; without them by the positions
  Worst velocity_mismatch_m_per_s;  ///< see TrajectoryLimits
  Worst position_step_m;            ///< what the mean of two velocities does not explain of a displacement
  Worst acceleration_m_per_s2;      ///< by the velocities; without them of the curve through the positions
  /// Without velocities, north, east, down: what the rounding of the numbers can do to the curve, 2 steps of the last
  /// decimal over the square of the usual interval, where it is more than the motion over a second has; else 0.
  nav::Vector3 rounding_m_per_s2 = nav::Vector3::Zero();
  Worst rate_deg_per_s;
  Worst off_track_deg;                  ///< faster than kTrackSpeed
  std::vector<TrajectoryFault> faults;  ///< in order of rows
};

/// Slower than this a velocity does not tell a direction, m/s.
inline constexpr double kTrackSpeed = 2.0;

/// The displacement from row - 1 to row in NED at the former, less the trapezoid of the two velocities, m.
nav::Vector3 unexplained_step_n(const TrajectoryFile& file, std::size_t row);

/// Measures a trajectory of two rows or more, and adds a problem to the reading for every place where it breaks a
/// limit; with `stop_at_first` measures no further than the first.
TrajectoryFigures judge_trajectory(TrajectoryReading& reading, const TrajectoryLimits& limits, bool stop_at_first);

}  // namespace inslab::trajectory
