#pragma once

#include <memory>
#include <string>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::verify {

/// A trajectory with the figure published for it.
struct LoopCase {
  std::string name;
  scenario::Trajectory trajectory;
  double published_position_m = 0.0;  ///< thesis table 4-2, RMS, to its four decimals
  time::Nanoseconds duration{0};
};

/// A tenth of the published figure, where that is 0.0003 m or below 3e-5 m.
double position_limit_m(const LoopCase& one);

/// The trajectories of thesis table 4-2, from the catalogue.
std::vector<LoopCase> loop_cases();

/// The same for an hour, the table's segments repeated; what ends itself is left out.
std::vector<LoopCase> for_an_hour(std::vector<LoopCase> cases);

/// Files at 200 Hz, `inverse_mechanization`, IMU, mechanization, against the files; and the same increments by the
/// independent mechanization.
Table inverse_mechanization_table(const std::string& title, const std::vector<LoopCase>& cases,
                                  const Subjects& subjects = {});

/// The first `duration` of the case's rows, at 10 Hz, with what real files have: velocities biased by some cm/s, a
/// position that jitters by 2 cm from row to row and steps by 0.5 m half-way.
std::shared_ptr<const TrajectoryFile> contradictory_rows(const LoopCase& one, time::Nanoseconds duration);

/// Files whose position and velocity contradict each other, by `inverse_mechanization`: how far the result goes from
/// the file's positions, beside the bound that file and feedback set.
Table contradiction_table(const std::vector<std::shared_ptr<const TrajectoryFile>>& files,
                          const Subjects& subjects = {});

/// The file at `path`, named without its folder, for contradiction_table(). Throws files::ReadError when it cannot be
/// read and json::Error, naming the place, when its rows are not a trajectory with velocity and attitude.
std::shared_ptr<const TrajectoryFile> real_rows(const std::string& path);

/// Block 2 of the verification: the catalogue as it is and for an hour by `inverse_mechanization`, sparse by `spline`,
/// then in both modes files that contradict themselves: a made one and those at `paths`.
std::vector<Table> closed_loop(const std::vector<std::string>& paths);

}  // namespace inslab::verify
