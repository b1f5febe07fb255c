#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/bus/service/clock_override.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/evidence/run_summary.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/judge.hpp"
#include "inslab/services/inslab/live/live_run.hpp"

namespace inslab::commands {

namespace {

int run(const live::RunOptions& given, const JudgeOutputs& outputs) {
  live::RunOptions options = given;
  scenario::LoadedScenario loaded = scenario::load(options.scenario);
  service::override_clock(options.clock, loaded);
  if (const std::string obstacle = live::obstacle_to(options, loaded); !obstacle.empty()) {
    terminal::tell(stderr, "inslab run: {}\n", obstacle);
    return host::kBadInput;
  }
  // Before anything is written: it throws when the unit has a set.
  auto live = std::make_unique<live::LiveRun>(options, loaded);
  if (options.log_file.empty()) {
    const std::string unit = options.network.unit.empty() ? "" : "-" + options.network.unit;
    options.log_file =
        files::fresh_file("runs/" + loaded.scenario.name + unit + "-" + host::utc_text(host::realtime_now()), ".mcap");
  }
  files::check_output(options.log_file);  // nothing may stand in the way at the end
  outputs.check(options.log_file);
  live->start_services();
  live->follow();
  const std::optional<std::string> failure = live->failure();
  for (const std::string& line : live->restarts()) terminal::tell("{}\n", line);
  live.reset();
  if (!std::filesystem::exists(options.log_file) || std::filesystem::is_empty(options.log_file)) {
    terminal::tell(stderr, "inslab run: {}; there is no log\n", failure.value_or("the logger wrote nothing"));
    return host::kFailed;
  }
  host::note_for_ending("the log " + options.log_file + " is there: inslab summary and report judge it");
  return judge_log(options.log_file, failure, outputs);
}

}  // namespace

void add_run(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<live::RunOptions>();
  auto outputs = std::make_shared<JudgeOutputs>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scenario live: one process for each service, real DDS, real time");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_option("--log", options->log_file, "file to write; default runs/NAME-TIME.mcap");
  command->add_flag("-v,--verbose", options->verbose, "show what the services say");
  outputs->add_to(*command);
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
      const mcap::McapReader reader(*log);
      const evidence::LogSummary summary = evidence::summarize(reader);
      const evidence::RunSummary said = evidence::run_summary(summary, evidence::weigh_swaps(reader, summary), {});
      terminal::tell("{}{}\n", said.text, said.outcome.words());
      return said.outcome.code;
    };
  });
}

}  // namespace inslab::commands
