#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/bus/client/own_client.hpp"
#include "inslab/bus/client/swap_transaction.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/play.hpp"

namespace inslab::commands {

void PlayOptions::add_to(CLI::App& command) {
  command
      .add_option("--timeout", timeout_s,
                  "seconds to wait in all; absent: as long as the run goes on, and 10 s beyond its last word")
      ->check(CLI::Range(0.0, 1e6));
  network.add_to(command);
}

int play_and_tell(const std::vector<catalog::AnyProfile>& swaps, const PlayOptions& options) {
  const host::OwnEnding leaves_the_domain(host::OwnEnding::Then::EndsBySignal);
  const auto client = client::client_of(options.network, "inslab-swap");
  const client::SwapsPlayed played =
      client::play_swaps(*client, swaps, options.timeout_s, options.network.words(), [](const ProfileAck& ack) {
        terminal::tell(ack.outcome == AckOutcome::Rejected ? stderr : stdout, "{}\n", client::words_of(ack));
      });
  if (!played.failure.empty()) terminal::tell(stderr, "inslab swap: {}\n", played.failure);
  return played.in_effect ? host::kOk : host::kNotApplied;
}

void add_schedule(CLI::App& app, std::function<int()>& action) {
  struct Options {
    std::string file;
    bool is_scenario = false;
    PlayOptions play;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("schedule", "Play a list of swaps on a running set; waits for every acknowledgement");
  command->add_option("file", options->file, "schedule (JSON): {\"swaps\": [...]} as in a scenario")->required();
  command->add_flag("--scenario", options->is_scenario, "the file is a scenario: play its swaps");
  options->play.add_to(*command);
  command->callback([options, &action] {
    action = [options] {
      const std::vector<catalog::AnyProfile> swaps = options->is_scenario
                                                         ? scenario::load(options->file).swaps
                                                         : scenario::load_schedule(options->file, host::random_id());
      return play_and_tell(swaps, options->play);
    };
  });
}

}  // namespace inslab::commands
