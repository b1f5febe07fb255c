#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/bus/client/own_client.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct ControlOptions {
  double value = 0.0;
  double timeout_s = 10.0;
  service::NetworkOptions network;
};

/// Sends a command and waits for what becomes of it: 0 obeyed, 3 refused or not answered.
int control(CommandKind kind, const ControlOptions& options) {
  const host::OwnEnding leaves_the_domain(host::OwnEnding::Then::EndsBySignal);
  const SimCommand command{host::random_id(), kind, options.value};
  const auto own = client::client_of(options.network, "inslab-control");
  client::RunClient& client = *own;
  const time::Nanoseconds deadline = host::monotonic_now() + time::from_seconds(options.timeout_s);
  const std::string server = "a trajectory server on " + options.network.words();
  if (!client::wait_for(
          deadline, [&] { return client.connected() && client.status(); }, server)) {
    terminal::tell(stderr, "inslab {}: {} was not found within {:g} s\n", enum_name(kind), server, options.timeout_s);
    return host::kNotApplied;
  }
  const auto judged = [&] { return client.status()->last_command_id == command.request_id; };
  if (!client.send(command) || !client::wait_for(deadline, judged, "the answer of the trajectory server")) {
    terminal::tell(stderr, "inslab {}: no answer within {:g} s\n", enum_name(kind), options.timeout_s);
    return host::kNotApplied;
  }
  const SimStatus status = *client.status();
  if (!status.last_command_refusal.empty()) {
    terminal::tell(stderr, "refused: {}\n", text::shown(status.last_command_refusal));
    return host::kNotApplied;
  }
  terminal::tell("{} at {:.9f} s of sim time, {} truth samples sent, rate {:g}\n", enum_name(status.state),
                 time::to_seconds(status.sim_time_ns), status.truth_samples, status.rate);
  return host::kOk;
}

}  // namespace

void add_control(CLI::App& app, std::function<int()>& action) {
  const auto add = [&](CommandKind kind, const char* purpose, const char* value, const char* meaning) {
    auto options = std::make_shared<ControlOptions>();
    CLI::App* command = app.add_subcommand(std::string(enum_name(kind)), purpose);
    if (value != nullptr) command->add_option(value, options->value, meaning)->required();
    command->add_option("--timeout", options->timeout_s, "seconds to wait for the answer, at most")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    options->network.add_to(*command);
    command->callback([&action, kind, options] { action = [kind, options] { return control(kind, *options); }; });
  };
  add(CommandKind::Pause, "Let sim time of a running set stand still", nullptr, nullptr);
  add(CommandKind::Resume, "Let it go on", nullptr, nullptr);
  add(CommandKind::Step, "Send so many truth samples of a paused set, then pause again", "samples",
      "number of truth samples");
  add(CommandKind::Rate, "Change the rate of a set in real time", "rate", "sim seconds per second");
  add(CommandKind::Stop, "End the run of a set, its log closed", nullptr, nullptr);
}

}  // namespace inslab::commands
