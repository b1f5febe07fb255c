#include "inslab/bus/client/doctor.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct DoctorOptions {
  bool clean = false;
  double seconds = 2.5;
  service::NetworkOptions network;
};

std::string variable_of_this_process(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

int doctor(const DoctorOptions& options) {
  std::size_t to_cure = 0;
  const auto show = [&to_cure](const client::Findings& findings) {
    terminal::tell("{}", client::words_of(findings));
    to_cure += findings.to_cure();
  };
  show(client::examine_environment(variable_of_this_process, "."));
  show(client::examine_socket_buffers("/proc/sys/net/core"));
  show(client::examine_shared_memory("/dev/shm", options.clean));
  show(client::examine_clock());
  show(client::examine_network(options.network, options.seconds));
  terminal::tell("{} {} to cure\n", to_cure, to_cure == 1 ? "finding" : "findings");
  return to_cure == 0 ? host::kOk : host::kFailed;
}

}  // namespace

void add_doctor(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand("doctor", "Look for what keeps a set from working, with the cure");
  command->add_flag("--clean", options->clean, "remove shared-memory segments that killed processes left");
  command->add_option("--seconds", options->seconds, "how long to listen on the network")
      ->check(CLI::Range(0.5, 60.0))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] { action = [options] { return doctor(*options); }; });
}

}  // namespace inslab::commands
