#pragma once

#include "inslab/referee/verify/subjects.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::verify {

/// The largest jumps of the published truth where one segment of a motion table follows another.
struct JointJumps {
  std::size_t joints = 0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double attitude_deg = 0.0;
  double rate_deg_per_s = 0.0;
  double specific_force_m_per_s2 = 0.0;
};

/// Each quantity at a joint against its polynomial through the samples before, at 200 Hz: of the third degree for the
/// position, whose published angles are rounded most, of the fifth for the rest. What remains without a jump is the
/// rounding of those samples, 15 and 63 times, and (5 ms)^4 or (5 ms)^6 of that derivative. Throws
/// std::invalid_argument for a joint within `duration_s` that no sample hits or that follows the one before within
/// 30 ms.
JointJumps jumps_at_joints(const scenario::Trajectory& trajectory, double duration_s,
                           const TruthOf& truth = product_truth);

}  // namespace inslab::verify
