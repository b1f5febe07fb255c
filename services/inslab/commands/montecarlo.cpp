#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/host/usage_error.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/montecarlo/single_run.hpp"
#include "inslab/referee/montecarlo/study_state.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/study/study_pool.hpp"

namespace inslab::commands {
namespace {

using montecarlo::ResultFolder;
using montecarlo::Study;

int do_one(const Study& study, const ResultFolder& folder, std::uint32_t run) {
  const auto result = montecarlo::single_run(study, run, host::shutdown_requested);
  if (!result) return host::kFailed;
  folder.keep(*result);
  if (!result->succeeded()) terminal::tell(stderr, "run {}: {}\n", run, result->failure);
  return result->succeeded() ? host::kOk : host::kFailed;
}

void run_open(const study::StudyOptions& options, const Study& study, const ResultFolder& folder,
              const montecarlo::Part& part) {
  const host::OwnEnding ends_them(host::OwnEnding::Then::EndsBySignal);
  study::StudyPool pool(
      options.jobs,
      {[&options](std::uint32_t run) { return study::study_process(options.arguments_of(run)); },
       [&](std::uint32_t run, const std::string& why) { montecarlo::keep_death(folder, study, run, why); },
       [&study](std::size_t done, std::size_t all) {
         terminal::tell(stderr, "{}: {} of {} runs done\n", study.loaded.scenario.name, done, all);
       },
       [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }, host::shutdown_requested});
  pool.run(montecarlo::open_runs(folder, part));
}

void tell_summary(const ResultFolder& folder, const montecarlo::Summary& summary) {
  const montecarlo::KeptSummary kept = montecarlo::keep_summary(folder, summary);
  terminal::tell("{}\n{} and .json written", kept.text, folder.file("summary.txt"));
  if (kept.has_picture) terminal::tell(", and .svg");
  if (!kept.why_no_picture.empty()) terminal::tell(stderr, "no picture: {}\n", kept.why_no_picture);
  terminal::tell("\n");
}

int run_montecarlo(const study::StudyOptions& options) {
  if (options.one && *options.one >= options.runs) {
    throw host::UsageError(fmt::format("--one {}: expected a run from 0 to {}", *options.one, options.runs - 1));
  }
  const Study study = montecarlo::load_study(options.scenario, options.parameters, options.draw_start, INSLAB_VERSION);
  const ResultFolder folder(options.directory, study);
  if (options.one) return do_one(study, folder, *options.one);
  const auto part = montecarlo::part_of(options.part, options.runs);
  if (!part) throw host::UsageError("--part " + options.part + ": expected K/T with 1 <= K <= T");
  if (!options.summary_only) run_open(options, study, folder, *part);
  const montecarlo::StudyState state = montecarlo::state_of(folder, options.runs, *part);
  if (state.results.size() < options.runs && !options.summary_only) {
    terminal::tell(
        "{} of {} runs are in {}; {}\n", state.results.size(), options.runs, options.directory,
        host::shutdown_requested() ? "interrupted: the same command goes on" : "the summary waits for the rest");
    return state.part_failed ? host::kFailed : host::kOk;
  }
  const montecarlo::Summary summary = montecarlo::summary_of(study.loaded.scenario.name, study.fingerprint,
                                                             study.loaded.scenario.seed, options.runs, state.results);
  tell_summary(folder, summary);
  return summary.complete() ? host::kOk : host::kFailed;
}

}  // namespace

void add_montecarlo(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<study::StudyOptions>();
  CLI::App* command = app.add_subcommand(kMontecarlo.name, kMontecarlo.purpose);
  command->add_option("scenario", options->scenario, "scenario file (JSON); run K has its seed plus K")->required();
  command->add_option("-n", options->runs, "how many runs")->check(CLI::Range(1u, 1000000u))->capture_default_str();
  command->add_option("-j", options->jobs, "how many at a time")
      ->check(CLI::Range(1u, 1024u))
      ->default_str("one for each core");
  command->add_option("-o,--output", options->directory, "folder of this study's results; runs that are there are kept")
      ->required();
  command->add_option(
      "--parameters", options->parameters,
      "what the filter believes (config/nav); absent: as the scenario says, or what matches its sensors");
  command->add_flag("--draw-start", options->draw_start,
                    "begin at the truth plus errors drawn from the filter's initial sigmas, without an alignment");
  command->add_option("--part", options->part, "K/T: only part K of T, such as one task of a job array");
  command->add_option("--one", options->one, "this run alone, in this process");
  command->add_flag("--summary-only", options->summary_only, "start no run; those that are missing are counted");
  command->callback([options, &action] { action = [options] { return run_montecarlo(*options); }; });
}

}  // namespace inslab::commands
