#pragma once

#include <deque>
#include <string>
#include <vector>

#include "inslab/referee/montecarlo/part.hpp"
#include "inslab/referee/montecarlo/result_folder.hpp"
#include "inslab/referee/montecarlo/summary.hpp"

namespace inslab::montecarlo {

/// What a folder has of a study's runs.
struct StudyState {
  std::vector<RunResult> results;
  bool part_failed = false;  ///< a run of the part has no result, or a failed one
};
StudyState state_of(const ResultFolder& folder, std::uint32_t runs, const Part& part);

/// The runs of a part that have not succeeded yet.
std::deque<std::uint32_t> open_runs(const ResultFolder& folder, const Part& part);

/// What is kept of a run that ended without having kept a result itself; nothing is when it has.
void keep_death(const ResultFolder& folder, const Study& study, std::uint32_t run, const std::string& why);

/// What keep_summary() wrote.
struct KeptSummary {
  std::string text;
  std::string why_no_picture;  ///< empty: there is one, or nothing to draw
  bool has_picture = false;
};
/// Writes summary.txt, .json and, when a run succeeded, .svg.
KeptSummary keep_summary(const ResultFolder& folder, const Summary& summary);

}  // namespace inslab::montecarlo
