#pragma once

#include <string>

#include "inslab/referee/score/verdict.hpp"

namespace inslab::score {

/// Whether a phase says what no other says, or an acceptance line asks for it: one to show a person.
bool is_shown(const PhaseKey& key, const Scorer& scorer, const std::vector<Verdict>& verdicts);

/// The score while the run goes on, in one line: the solutions that have been judged lie some seconds behind those that
/// have come, since late ones are waited for. Empty when no solution has come.
std::string score_so_far(const Scorer& scorer);

/// The score of a run for people: what came of the app, its errors per phase, its outages, PASS or FAIL a line.
std::string score_text(const Scorer& scorer, const std::vector<Verdict>& verdicts);

/// The acceptance as JUnit XML: one test case a line, in a suite of this name.
std::string junit_xml(const std::string& suite, const std::vector<Verdict>& verdicts);

}  // namespace inslab::score
