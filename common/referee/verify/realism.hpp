#pragma once

#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// What a real set has and a simple simulation lacks, one cause at a time: the navigation-grade IMU of the thesis in
/// its drives from parameters, whose filter is told nothing of the cause, and what the drift in its outages becomes.
/// Beside it what an independent simulation found when it altered recorded files by the same causes; a row holds when
/// what the cause adds is within a factor 2 of that, either way.
Table realism_table(const OutageRuns& runs, const Subjects& subjects = {});

}  // namespace inslab::verify
