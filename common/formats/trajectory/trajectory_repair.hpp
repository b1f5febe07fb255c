#pragma once

#include <string>
#include <vector>

#include "inslab/formats/trajectory/trajectory_judge.hpp"

namespace inslab::trajectory {

/// What a repair may do, beyond which it leaves a fault alone and says so.
struct RepairBounds {
  double max_spread_s = 30.0;         ///< a step of position or attitude is spread over at most so long before it
  double max_turned_deg = 10.0;       ///< an attitude that is reset by more says nothing of the time before
  double max_standing_m_per_s = 1.0;  ///< slower than this a vehicle stands: it had the attitude it shows afterwards
  double max_filled_gap_s = 30.0;
};

/// One change, or one fault that was left: where and what.
struct RepairNote {
  bool is_repaired = false;
  std::string text;
};

/// Repairs a trajectory that was read with stop_at_first = false (lines that could not be read are out already), in
/// this order:
///
/// - attitude resets: a small one is spread over the time before it; before a large one the attitude is held back from
///   after it, if the vehicle stood
/// - position steps: spread over the time before, back to the step before; the velocity takes the spread's slope, so
///   that both still agree
/// - velocities that contradict the positions or jump: those within a second are derived from the positions
/// - gaps: bridged by cubics through position and velocity at both ends, attitudes by the shortest turn, at the median
///   interval of the file
///
/// What each did to which lines is added to `notes`. The rows must still be judged: not every fault can be repaired.
TrajectoryReading repaired(const TrajectoryReading& reading, const TrajectoryLimits& limits, const RepairBounds& bounds,
                           std::vector<RepairNote>& notes);

}  // namespace inslab::trajectory
