#pragma once

#include <vector>

#include "inslab/referee/evidence/swap_evidence.hpp"
#include "inslab/referee/evidence/swap_window.hpp"

namespace inslab::evidence {

/// What the tags of a swapped sensor show of its clock, whatever its kind: their mean error, and their jitter from
/// first differences. Nothing where neither profile has an error of the clock. `period_s`: of the sensor's rate.
std::vector<EvidenceLine> time_tag_lines(const LogSummary& summary, const SwapWindows& swap, double period_s);

}  // namespace inslab::evidence
