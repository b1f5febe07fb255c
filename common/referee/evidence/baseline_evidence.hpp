#pragma once

#include <vector>

#include "inslab/referee/evidence/swap_evidence.hpp"
#include "inslab/referee/evidence/swap_window.hpp"

namespace inslab::evidence {

/// What a swap of a two-antenna heading's installation promises: the vector from the first antenna to the second.
std::vector<EvidenceLine> baseline_lines(const LogSummary& summary, const SwapWindows& swap);

/// What a swap of its errors promises: the noise of the second antenna's position relative to the first.
std::vector<EvidenceLine> baseline_noise_lines(const LogSummary& summary, const SwapWindows& swap, double period_s);

}  // namespace inslab::evidence
