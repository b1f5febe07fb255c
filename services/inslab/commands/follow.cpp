#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "inslab/bus/client/own_client.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/follower.hpp"
#include "inslab/services/inslab/live/progress.hpp"

namespace inslab::commands {

namespace {

struct FollowOptions {
  std::string scenario;
  double timeout_s = 60.0;
  bool release = false;
  service::NetworkOptions network;
};

/// For whoever waits for it: at once, though it may go into a pipe.
void say_at_once(const std::string& line) {
  terminal::tell("{}\n", line);
  std::fflush(stdout);
}

int follow(const FollowOptions& options, const scenario::LoadedScenario& loaded) {
  const host::OwnEnding leaves_the_domain(host::OwnEnding::Then::CodeStands);
  const auto client = client::client_of(options.network, "inslab-follow");
  live::Progress progress(loaded.scenario.name, time::from_seconds(loaded.scenario.duration_s));
  const auto word = [&progress](const std::string& words) { progress.say("inslab follow: " + words); };
  live::Follower follower(
      *client, {options.timeout_s, options.release, "domain " + std::to_string(options.network.domain), loaded.swaps},
      {say_at_once, word, [&progress](time::Nanoseconds sim_time) { progress.show(sim_time); }}, host::monotonic_now());
  while (!host::shutdown_requested()) {
    if (const auto ending = follower.step(host::monotonic_now())) {
      if (!ending->good) word(ending->why);
      return ending->good ? host::kOk : host::kFailed;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  word("stopped by a signal; the set goes on");
  return host::kFailed;
}

}  // namespace

void add_follow(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<FollowOptions>();
  CLI::App* command = app.add_subcommand(
      "follow",
      "Go along with a set that was started service by service: send the scenario's swaps, show how far it is, "
      "end with it");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_flag("--release", options->release,
                    "let the run, started with --paused, begin as soon as all the swaps are in its journal");
  command->add_option("--timeout", options->timeout_s, "seconds to wait after the last word of the set")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] {
    action = [options] {
      const scenario::LoadedScenario loaded =
          scenario::load(options->scenario, options->network.unit, scenario::TrajectoryRows::LeaveOut);
      return follow(*options, loaded);
    };
  });
}

}  // namespace inslab::commands
