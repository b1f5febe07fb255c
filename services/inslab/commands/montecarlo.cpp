#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <deque>
#include <memory>
#include <thread>

#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/referee/montecarlo/result_folder.hpp"
#include "inslab/referee/montecarlo/single_run.hpp"
#include "inslab/referee/montecarlo/summary_picture.hpp"
#include "inslab/referee/montecarlo/summary_text.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/child_processes.hpp"

namespace inslab::cli {

namespace {

using montecarlo::ResultFolder;
using montecarlo::RunResult;
using montecarlo::Study;

struct MontecarloOptions {
  std::string scenario;
  std::string parameters;
  std::string directory;
  std::string part;
  std::uint32_t runs = 100;
  std::uint32_t jobs = std::max(1u, std::thread::hardware_concurrency());
  std::optional<std::uint32_t> one;
  bool draw_start = false;
  bool summary_only = false;
};

/// Runs `first` to `end` - 1.
struct Part {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Part K of T, as equal as they can be, or all. Throws io::ReadError.
Part part_of(const MontecarloOptions& options) {
  if (options.part.empty()) return {0, options.runs};
  std::uint32_t k = 0, parts = 0;
  char rest = 0;
  const bool is_read = std::sscanf(options.part.c_str(), "%" SCNu32 "/%" SCNu32 "%c", &k, &parts, &rest) == 2;
  if (!is_read || options.part.find_first_not_of("0123456789/") != std::string::npos || k < 1 || k > parts) {
    throw io::ReadError("--part " + options.part + ": expected K/T with 1 <= K <= T");
  }
  const auto bound = [&](std::uint64_t i) { return static_cast<std::uint32_t>(options.runs * i / parts); };
  return {bound(k - 1), bound(k)};
}

int do_one(const Study& study, const ResultFolder& folder, std::uint32_t run) {
  const auto result = montecarlo::single_run(study, run, app::shutdown_requested);
  if (!result) return app::kFailed;
  folder.keep(*result);
  if (!result->succeeded()) std::cerr << fmt::format("run {}: {}\n", run, result->failure);
  return result->succeeded() ? app::kOk : app::kFailed;
}

/// Each run a process of its own, so many at a time: one that dies takes none along.
class RunProcesses {
 public:
  RunProcesses(const MontecarloOptions& options, const Study& study, const ResultFolder& folder)
      : options_(options), study_(study), folder_(folder) {}

  void run(std::deque<std::uint32_t> todo) {
    const app::OwnEnding ends_them(app::OwnEnding::Then::EndsBySignal);
    const std::size_t all = todo.size();
    while ((!todo.empty() || !active_.empty()) && !app::shutdown_requested()) {
      for (; !todo.empty() && active_.size() < options_.jobs; todo.pop_front()) start(todo.front());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      collect();
      show(all - todo.size() - active_.size(), all);
    }
    active_.clear();  // ends those that still run
  }

 private:
  struct Active {
    std::uint32_t run;
    std::unique_ptr<ChildProcesses> process;
  };

  void start(std::uint32_t run) {
    std::vector<std::string> words{
        "montecarlo", options_.scenario,  "-o", options_.directory, "-n", std::to_string(options_.runs),
        "--one",      std::to_string(run)};
    if (!options_.parameters.empty()) words.insert(words.end(), {"--parameters", options_.parameters});
    if (options_.draw_start) words.emplace_back("--draw-start");
    active_.push_back({run, std::make_unique<ChildProcesses>()});
    active_.back().process->start("inslab-study", words);
  }

  void collect() {
    for (auto entry = active_.begin(); entry != active_.end();) {
      entry->process->poll();
      if (!entry->process->all_ended()) {
        ++entry;
        continue;
      }
      const auto failure = entry->process->failure();
      if (failure && !folder_.result(entry->run)) note_death(entry->run, *failure);
      entry = active_.erase(entry);
    }
  }

  /// A run that could not say itself why there is no result.
  void note_death(std::uint32_t run, const std::string& failure) const {
    RunResult result;
    result.fingerprint = study_.fingerprint;
    result.run = run;
    result.seed = study_.seed_of(run);
    result.failure = failure;
    folder_.keep(result);
  }

  /// A line every tenth of the way.
  void show(std::size_t done, std::size_t all) {
    const std::size_t tenth = done * 10 / all;
    if (tenth == shown_) return;
    shown_ = tenth;
    std::cerr << fmt::format("{}: {} of {} runs done\n", study_.loaded.scenario.name, done, all);
  }

  const MontecarloOptions& options_;
  const Study& study_;
  const ResultFolder& folder_;
  std::vector<Active> active_;
  std::size_t shown_ = 0;
};

void write_summary(const ResultFolder& folder, const montecarlo::Summary& summary) {
  const std::string text = montecarlo::summary_text(summary);
  folder.keep("summary.txt", text);
  folder.keep("summary.json", montecarlo::summary_json(summary).dump(2) + "\n");
  tell("{}\n{} and .json written", text, folder.file("summary.txt"));
  if (summary.succeeded > 0) {
    try {
      folder.keep("summary.svg", io::drawn(montecarlo::summary_picture(summary), io::PictureFormat::Svg));
      tell(", and .svg");
    } catch (const io::PictureError& error) {  // a compute node need not have gnuplot
      std::cerr << "no picture: " << error.what() << "\n";
    }
  }
  tell("\n");
}

int run_montecarlo(const MontecarloOptions& options) {
  if (options.one && *options.one >= options.runs) {
    throw io::ReadError(fmt::format("--one {}: expected a run from 0 to {}", *options.one, options.runs - 1));
  }
  const Study study = montecarlo::load_study(options.scenario, options.parameters, options.draw_start, INSLAB_VERSION);
  const ResultFolder folder(options.directory, study);
  if (options.one) return do_one(study, folder, *options.one);

  const Part part = part_of(options);
  std::deque<std::uint32_t> todo;
  for (std::uint32_t run = part.first; run < part.end && !options.summary_only; ++run) {
    const auto result = folder.result(run);
    if (!result || !result->succeeded()) todo.push_back(run);
  }
  RunProcesses(options, study, folder).run(std::move(todo));

  std::vector<RunResult> results;
  bool part_failed = false;
  for (std::uint32_t run = 0; run < options.runs; ++run) {
    auto result = folder.result(run);
    if (run >= part.first && run < part.end) part_failed |= !result || !result->succeeded();
    if (result) results.push_back(std::move(*result));
  }
  if (results.size() < options.runs && !options.summary_only) {
    tell("{} of {} runs are in {}; {}\n", results.size(), options.runs, options.directory,
         app::shutdown_requested() ? "interrupted: the same command goes on" : "the summary waits for the rest");
    return part_failed ? app::kFailed : app::kOk;
  }
  const montecarlo::Summary summary = montecarlo::summary_of(study.loaded.scenario.name, study.fingerprint,
                                                             study.loaded.scenario.seed, options.runs, results);
  write_summary(folder, summary);
  return summary.complete() ? app::kOk : app::kFailed;
}

}  // namespace

void add_montecarlo(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<MontecarloOptions>();
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

}  // namespace inslab::cli
