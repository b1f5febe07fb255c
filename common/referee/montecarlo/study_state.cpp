#include "inslab/referee/montecarlo/study_state.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/montecarlo/summary_picture.hpp"
#include "inslab/referee/montecarlo/summary_text.hpp"

namespace inslab::montecarlo {

StudyState state_of(const ResultFolder& folder, std::uint32_t runs, const Part& part) {
  StudyState state;
  for (std::uint32_t run = 0; run < runs; ++run) {
    auto result = folder.result(run);
    if (run >= part.first && run < part.end) state.part_failed |= !result || !result->succeeded();
    if (result) state.results.push_back(std::move(*result));
  }
  return state;
}

std::deque<std::uint32_t> open_runs(const ResultFolder& folder, const Part& part) {
  std::deque<std::uint32_t> open;
  for (std::uint32_t run = part.first; run < part.end; ++run) {
    const auto result = folder.result(run);
    if (!result || !result->succeeded()) open.push_back(run);
  }
  return open;
}

void keep_death(const ResultFolder& folder, const Study& study, std::uint32_t run, const std::string& why) {
  if (folder.result(run)) return;
  RunResult result;
  result.fingerprint = study.fingerprint;
  result.run = run;
  result.seed = study.seed_of(run);
  result.failure = why;
  folder.keep(result);
}

KeptSummary keep_summary(const ResultFolder& folder, const Summary& summary) {
  KeptSummary kept{summary_text(summary), "", false};
  folder.keep("summary.txt", kept.text);
  folder.keep("summary.json", summary_json(summary).dump(2) + "\n");
  if (summary.succeeded == 0) return kept;
  try {
    folder.keep("summary.svg", tables::drawn(summary_picture(summary), tables::PictureFormat::Svg));
    kept.has_picture = true;
  } catch (const tables::PictureError& error) {  // a compute node need not have gnuplot
    kept.why_no_picture = error.what();
  }
  return kept;
}

}  // namespace inslab::montecarlo
