#pragma once

#include <functional>

#include "score/acceptance.hpp"
#include "services/inslab/log_summary.hpp"

namespace inslab::cli {

/// A log scored as the logger scored the run: the same figures from the same samples in the same order.
struct LogScore {
  score::Scorer scorer;
  std::vector<score::Verdict> verdicts;

  bool accepted() const;
};

/// Reads the log once. `on_scored` is told of each scored solution. Throws io::ReadError.
LogScore score_log(const io::McapReader& log, const LogSummary& summary,
                   const std::function<void(const score::ScoredSolution&)>& on_scored = {});

}  // namespace inslab::cli
