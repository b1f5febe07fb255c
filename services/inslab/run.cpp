#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/clock_override.hpp"
#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "io/output_file.hpp"
#include "score/score_text.hpp"
#include "services/inslab/commands.hpp"
#include "services/inslab/live_run.hpp"
#include "services/inslab/report_files.hpp"
#include "services/inslab/run_summary.hpp"
#include "services/inslab/score_log.hpp"
#include "services/inslab/score_words.hpp"
#include "services/reference_nav/app_setup.hpp"

namespace inslab::cli {

namespace {

/// What is written besides the log; empty: not that.
struct Outputs {
  std::string junit;
  std::string report_folder;
};

/// Nothing that is there already may stand in the way at the end of a run.
void check_outputs(const std::string& log_file, const Outputs& outputs) {
  io::check_output(log_file);
  if (!outputs.junit.empty()) io::check_output(outputs.junit);
  if (outputs.report_folder.empty()) return;
  for (const std::string& path : report_paths(log_file, outputs.report_folder)) io::check_output(path);
}

/// What the checks and the acceptance come to together; both are in the last line when they are as good.
app::Outcome with_acceptance(const app::Outcome& checks, const std::string& verdict, bool accepted) {
  if (checks.code == app::kOk && accepted) return {app::kOk, checks.reason + "; " + verdict};
  return worse(checks, {accepted ? app::kOk : app::kNotAccepted, verdict});
}

int run(RunOptions options, const Outputs& outputs) {
  scenario::LoadedScenario loaded = scenario::load(options.scenario);
  app::override_clock(options.clock, loaded);
  if (const auto& app = loaded.scenario.reference_nav) (void)reference_nav::setup_for(loaded, *app);
  // Before anything is written: it throws when the unit has a set.
  auto live = std::make_unique<LiveRun>(options, loaded);
  if (options.log_file.empty()) {
    const std::string unit = options.network.unit.empty() ? "" : "-" + options.network.unit;
    options.log_file =
        io::fresh_file("runs/" + loaded.scenario.name + unit + "-" + app::utc_text(app::realtime_now()), ".mcap");
  }
  check_outputs(options.log_file, outputs);
  live->start_services();
  live->follow();
  const std::optional<std::string> failure = live->failure();
  live.reset();
  if (!std::filesystem::exists(options.log_file) || std::filesystem::is_empty(options.log_file)) {
    std::fprintf(stderr, "inslab run: %s; there is no log\n", failure ? failure->c_str() : "the logger wrote nothing");
    return app::kFailed;
  }
  app::Outcome outcome = print_run_summary(options.log_file, failure);
  const io::McapReader log(options.log_file);
  const LogSummary summary = summarize(log);
  const LogScore score = score_log(log, summary);
  if (score.scorer.counts().received > 0 || !score.verdicts.empty()) {
    std::fputs(score_words(score, summary).c_str(), stdout);
  }
  if (!outputs.report_folder.empty()) {
    std::printf("\nreport %s.html\n", write_report(log, report_data(log), outputs.report_folder).c_str());
  }
  if (!outputs.junit.empty()) io::write_file(outputs.junit, score::junit_xml(loaded.scenario.name, score.verdicts));
  if (!score.verdicts.empty()) outcome = with_acceptance(outcome, verdict_words(score, summary), score.accepted());
  std::printf("%s\n", outcome.words().c_str());
  return outcome.code;
}

}  // namespace

void add_run(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<RunOptions>();
  auto outputs = std::make_shared<Outputs>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scenario live: one process for each service, real DDS, real time");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_option("--log", options->log_file, "file to write; default runs/NAME-TIME.mcap");
  command->add_flag("-v,--verbose", options->verbose, "show what the services say");
  command->add_option("--junit", outputs->junit, "write the acceptance as JUnit XML to this file");
  command->add_option("--report", outputs->report_folder,
                      "write what `inslab report` says of the log into this folder");
  options->network.add_to(*command);
  options->clock.add_to(*command);
  add_overwrite(*command);
  command->callback([options, outputs, &action] { action = [options, outputs] { return run(*options, *outputs); }; });
}

void add_summary(CLI::App& app, std::function<int()>& action) {
  auto log = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "summary", "What a log says about its live run: streams, services, swaps with their evidence, checks");
  command->add_option("log", *log, "log (MCAP)")->required();
  command->callback([log, &action] {
    action = [log] {
      const app::Outcome outcome = print_run_summary(*log, {});
      std::printf("%s\n", outcome.words().c_str());
      return outcome.code;
    };
  });
}

}  // namespace inslab::cli
