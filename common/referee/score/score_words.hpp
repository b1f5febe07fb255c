#pragma once

#include <string>

#include "inslab/referee/score/score_log.hpp"

namespace inslab::score {

/// "22.8 m horizontally and 0.65 m vertically at 41.900 s, 9.95 s after the last fix (outage from ... to ...), at 15.0
/// m/s, ...": the worst moment of the score with what was going on. Empty when nothing was scored.
std::string worst_words(const LogScore& score);

/// What the acceptance leaves unjudged although the run had it: "errors are judged only before the first swap, at
/// 15.000 s". Empty when it judges all, or nothing.
std::string unjudged_words(const LogScore& score);

/// "PASS: 3 of 3 acceptance lines passed", with what they leave unjudged; empty when nothing was asked for.
std::string verdict_words(const LogScore& score);

/// The score for the terminal: score::score_text, the worst moment, the names of the swap intervals, the verdict.
std::string score_words(const LogScore& score);

}  // namespace inslab::score
