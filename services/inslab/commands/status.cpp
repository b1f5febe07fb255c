#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/client/set_listener.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct StatusOptions {
  std::string scenario;
  double wait_s = 2.2;
  bool once = false;
  service::NetworkOptions network;
};

int show_once(const StatusOptions& options, const std::vector<scenario::ServiceKey>& expected) {
  if (options.wait_s > 2.0)
    terminal::tell(stderr, "listens for {:g} s on {}\n", options.wait_s, options.network.words());
  const client::SetListener listener(options.network);
  const time::Nanoseconds begun = host::monotonic_now();
  client::listen_for(options.wait_s);
  // What came in the first moments may be the latched word of a service that has died since.
  const time::Nanoseconds since = begun + time::from_seconds(options.wait_s - 1.5);
  const std::vector<client::Heartbeats> services = listener.living(since);
  const std::vector<scenario::ServiceKey> missing = client::missing_of(expected, services);
  terminal::tell("{}{}", client::run_table(listener.run(), listener.vehicle(), options.network.words()),
                 client::service_table(services, missing));
  return missing.empty() ? host::kOk : host::kFailed;
}

/// The table in place, twice a second, until the run has ended or Ctrl-C.
int show_live(const StatusOptions& options, const std::vector<scenario::ServiceKey>& expected) {
  const host::OwnEnding leaves_the_domain(host::OwnEnding::Then::CodeStands);
  const client::SetListener listener(options.network);
  bool complete = false;
  while (!host::shutdown_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const time::Nanoseconds since = host::monotonic_now() - time::from_seconds(options.wait_s);
    const std::vector<client::Heartbeats> services = listener.living(since);
    const std::vector<scenario::ServiceKey> missing = client::missing_of(expected, services);
    complete = missing.empty();
    fmt::print("\033[H\033[J{}{}{}", client::run_table(listener.run(), listener.vehicle(), options.network.words()),
               client::service_table(services, missing), client::stream_table(services));
    std::fflush(stdout);
    const auto run = listener.run();
    if (run && has_ended(run->state)) break;
  }
  return complete ? host::kOk : host::kFailed;
}

int status(const StatusOptions& options) {
  const std::vector<scenario::ServiceKey> expected = client::expected_services(options.scenario);
  const bool live = !options.once && isatty(STDOUT_FILENO) == 1;
  return live ? show_live(options, expected) : show_once(options, expected);
}

}  // namespace

void add_status(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<StatusOptions>();
  CLI::App* command = app.add_subcommand(
      "status", "Show the services of a running set and who is missing; on a terminal, a live table");
  command->add_option("scenario", options->scenario, "scenario file: expect its services; absent: one of each");
  command->add_flag("--once", options->once, "one look, as where the output is no terminal");
  command->add_option("--wait", options->wait_s, "seconds to listen")
      ->check(CLI::Range(2.0, 60.0))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] { action = [options] { return status(*options); }; });
}

}  // namespace inslab::commands
