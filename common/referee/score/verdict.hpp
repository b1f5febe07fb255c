#pragma once

#include <string>

#include "inslab/referee/score/scorer.hpp"

namespace inslab::score {

/// The figure, in the unit of its name; nothing when no solution speaks for it.
std::optional<double> figure(const Scorer& scorer, scenario::Metric metric, const PhaseKey& phase);

/// One line of the scenario's acceptance with what came of it.
struct Verdict {
  scenario::AcceptanceLimit limit;
  std::optional<double> value;
  bool passed = false;
  std::string why;  ///< of a line that failed: "is above 3", "no solution", ...
};

/// A metric of single solutions is judged only where solutions cover at least this share of its phase's time: an app
/// that is missing, or late, fails.
inline constexpr double kLeastCover = 0.9;

/// Every line in order; empty when the scenario asks for nothing.
std::vector<Verdict> judge(const Scorer& scorer, const std::vector<scenario::AcceptanceLimit>& acceptance);

/// "cep50_m, outages, after 60 s, at most 3": a line of the scenario in words.
std::string words_of(const scenario::AcceptanceLimit& limit);
/// "outages, after 60 s": a phase in words.
std::string words_of(const PhaseKey& phase);

}  // namespace inslab::score
