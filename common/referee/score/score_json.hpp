#pragma once

#include <nlohmann/json.hpp>

#include "inslab/referee/score/verdict.hpp"

namespace inslab::score {

/// Every figure of docs/scoring.md by name, per phase, with the outages and the acceptance lines. A figure without a
/// value is null.
nlohmann::ordered_json score_json(const Scorer& scorer, const std::vector<Verdict>& verdicts);

}  // namespace inslab::score
