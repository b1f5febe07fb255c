#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/referee/verify/deviation.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::verify {

/// The rows of a motion table's first `duration` at `rate`, fewer when the motion ends itself before: written to a file
/// (recordings::NavTextWriter) in the system's folder for temporary files, and read from it. `name` is part of the
/// file's name. Throws files::WriteError.
std::shared_ptr<const TrajectoryFile> rows_as_written(const scenario::Trajectory& trajectory, const std::string& name,
                                                      const time::Rate& rate, time::Nanoseconds duration);

/// What a mechanization is held against at an instant of the truth.
using ExpectedState = std::function<nav::NavState(const TruthState& truth)>;

/// Truth to perfect IMU to each of the mechanizations, which begin at the truth's first state, for `steps` intervals of
/// `rate`; each state found is held against `expected`, asked once an instant. One entry for each mechanization.
struct LoopedMechanization {
  MechanizationOf mechanization;
  nav::Strapdown::Options options;
};
std::vector<DeviationFigures> close_loop(trajectory::TruthModel& truth, const ImuOf& imu, const nav::Gravity& gravity,
                                         const std::vector<LoopedMechanization>& mechanizations, const time::Rate& rate,
                                         std::uint64_t steps, const ExpectedState& expected);

/// How far two mechanizations of the same increments are from a file's rows.
struct FileLoop {
  DeviationFigures app;          ///< the one under test
  DeviationFigures independent;  ///< reference_mechanization()
};
/// The rows by `inverse_mechanization` to increments, both mechanizations of them against the rows.
FileLoop close_file_loop(const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity,
                         const time::Rate& rate, const Subjects& subjects);

}  // namespace inslab::verify
