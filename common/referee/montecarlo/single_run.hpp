#pragma once

#include <functional>

#include "inslab/referee/montecarlo/run_result.hpp"
#include "inslab/referee/montecarlo/study.hpp"

namespace inslab::montecarlo {

/// Simulates the scenario with the run's seed, lets the reference navigation app navigate, and scores it as a live one
/// is. What goes wrong, a filter that never begins included, is the result's failure. Nothing when `stop` said so.
std::optional<RunResult> single_run(const Study& study, std::uint32_t run, const std::function<bool()>& stop);

}  // namespace inslab::montecarlo
