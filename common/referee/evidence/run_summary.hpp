#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/foundation/host/outcome.hpp"
#include "inslab/referee/evidence/swap_evidence.hpp"

namespace inslab::evidence {

/// What a log says about a run, in words, and what it comes to.
struct RunSummary {
  std::string text;
  host::Outcome outcome;  ///< kFailed with the first check that did not hold
};

/// Per topic what was sent, received, lost and how old it was; per swap its acknowledgement, its first sample and the
/// noise measured before and after beside what the profiles promise; the checks that did not hold; the path of the log.
/// Of a log of `inslab simulate`, which has no services, the streams and the swaps are checked. `failure` is what the
/// one who ran it saw go wrong, if anything.
RunSummary run_summary(const LogSummary& summary, const std::vector<SwapEvidence>& swaps,
                       const std::optional<std::string>& failure);

}  // namespace inslab::evidence
