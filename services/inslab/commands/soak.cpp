#include "inslab/services/inslab/study/soak.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/files/output_place.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

void say_text(const std::string& text) { terminal::tell("{}", text); }

int soak(study::SoakOptions options, bool keep_log) {
  const scenario::LoadedScenario loaded = scenario::load(options.run.scenario);
  if (options.hours * 3600.0 > loaded.scenario.duration_s) {
    terminal::tell(stderr, "inslab soak: {} lasts {:g} h; {:g} h were asked for\n", options.run.scenario,
                   loaded.scenario.duration_s / 3600.0, options.hours);
    return host::kBadInput;
  }
  if (options.profiles.empty()) {
    options.profiles = (std::filesystem::path(options.run.scenario).parent_path() / "../profiles").lexically_normal();
  }
  const std::string name = loaded.scenario.name + "-" + host::utc_text(host::realtime_now());
  options.run.clock.mode = "lockstep";
  study::Soak run(options, loaded, say_text);  // before anything is written: it throws when the unit has a set
  if (options.run.log_file.empty()) options.run.log_file = files::fresh_file("runs/soak-" + name, ".mcap");
  files::check_output(options.run.log_file);
  const bool good = run.go();
  if (good && !keep_log) {
    std::filesystem::remove(options.run.log_file);
    terminal::tell("the log is removed; --keep-log keeps it\n");
  } else {
    terminal::tell("log {}\n", options.run.log_file);
  }
  return good ? host::kOk : host::kFailed;
}

}  // namespace

void add_soak(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<study::SoakOptions>();
  auto keep_log = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(kSoak.name, kSoak.purpose);
  command->add_option("scenario", options->run.scenario, "scenario file (JSON)")
      ->default_val("config/scenarios/soak.json");
  command->add_option("--hours", options->hours, "of sim time")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of what happens when")->capture_default_str();
  command->add_option("--often", options->often, "so many times as many kills and pauses")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command->add_option("--load", options->load, "busy threads beside the set")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--profiles", options->profiles,
                      "folder of the profiles to swap to; default ../profiles beside the scenario");
  command->add_option("--log", options->run.log_file, "file to write; default runs/soak-NAME-TIME.mcap");
  command->add_flag("--keep-log", *keep_log, "keep the log even when everything held");
  options->run.network.add_to(*command);
  add_overwrite(*command);
  command->callback(
      [options, keep_log, &action] { action = [options, keep_log] { return soak(*options, *keep_log); }; });
}

}  // namespace inslab::commands
