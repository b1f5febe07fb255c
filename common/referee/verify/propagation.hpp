#pragma once

#include <string>
#include <vector>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

/// How errors of inertial navigation grow, against the closed forms and the linear model of the lecture: block 7 of the
/// verification. Runs of propagation_runs.hpp.
namespace inslab::verify {

/// The four sources of the lecture's figure 2 over 4 h: each run's north position against (68) over the first Schuler
/// period, and all its horizontal errors of position against the linear model throughout. Then the Schuler period.
std::vector<Table> schuler_tables(const Subjects& subjects = {});

/// The height left free: (72) until 30 min, and the time in which the error doubles.
Table height_table(const Subjects& subjects = {});

/// Seeds 1 to `runs` of an hour at rest with a navigation-grade IMU, the height held and free: the CEP against the
/// statement of 1 to 2 nautical miles, and the drift's size against the prediction of predict::ErrorGrowth. At least 10
/// runs.
Table drift_table(int runs, const Subjects& subjects = {});

/// Runs, linear model and (68) of the four sources.
tables::Picture propagation_picture();

/// The whole block: 200 runs of drift, or with `full` 1000.
std::vector<Table> propagation(bool full);

}  // namespace inslab::verify
