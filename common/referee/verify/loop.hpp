#pragma once

#include <functional>
#include <memory>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/referee/verify/deviation.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::verify {

/// The rows of a motion table's first `duration` at `rate`, fewer when the motion ends itself before: written to a file
/// (recordings::NavTextWriter) in the system's folder for temporary files, and read from it. `name` is part of the
/// file's name. Throws files::WriteError.
std::shared_ptr<const TrajectoryFile> rows_as_written(const scenario::Trajectory& trajectory, const std::string& name,
                                                      const time::Rate& rate, time::Nanoseconds duration);

/// Truth to perfect IMU to a navigation app's two-sample mechanization that begins at the truth's first state, for
/// `steps` intervals of `rate`; each state found is held against `expected`.
DeviationFigures close_loop(trajectory::TruthModel& truth, const nav::Gravity& gravity,
                            const nav::Strapdown::Options& options, const time::Rate& rate, std::uint64_t steps,
                            const std::function<nav::NavState(const TruthState&)>& expected);

/// The same with `inverse_mechanization` of `file` as truth, held against the file, as far as the file reaches.
DeviationFigures close_file_loop(const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity,
                                 const time::Rate& rate);

}  // namespace inslab::verify
