#pragma once

#include <memory>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::verify {

/// A drive through a town that the seed draws, after a rest of `standing_s`: legs of 15 to 60 s at 8 to 14 m/s with
/// uneven speed, over slopes of up to 1.5 deg, each ended by a turn of 70 to 110 deg to either side at 5 to 7 m/s or,
/// three times in ten, by a stop before it. Its turns are about as frequent and its accelerations about as large as in
/// the RTK positions that come with KF-GINS: one turn in 77 s, 0.54 m/s^2 along and 0.47 m/s^2 across, RMS while
/// moving.
scenario::Trajectory town_drive(std::uint64_t seed, double standing_s, double duration_s);

/// The drive as a navigation system recorded it, rows of 11 columns at 200 Hz: the solution of the reference filter
/// with the navigation-grade IMU and RTK fixes of thesis table 4-10 and 4-8, so with the jumps and contradictions of a
/// real solution.
std::shared_ptr<const TrajectoryFile> recorded_drive(std::uint64_t seed, double standing_s, double duration_s);

}  // namespace inslab::verify
