#include "inslab/bus/service/service_options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/foundation/fields/unit_name.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/finite_numbers.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/network_interfaces.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::service {

namespace {

/// Makes an address of the name of an interface; refuses what this host lacks.
std::string to_address(std::string& wanted) {
  if (wanted == "any") return "";
  const std::vector<host::NetworkInterface> here = host::network_interfaces();
  const auto address = host::address_on(here, wanted);
  if (!address)
    return "this host has no interface '" + text::shown(wanted) + "'; it has " + host::words_of(here) + ", or any";
  wanted = *address;
  return "";
}

std::string judge_unit(const std::string& name) {
  if (name.empty() || is_unit_name(name)) return "";
  return "'" + text::shown(name) + "' names no unit; expected " + kUnitNameRule;
}

}  // namespace

void add_unit_option(CLI::App& app, std::string& unit, const std::string& meaning) {
  app.add_option("--unit", unit, meaning)->check(CLI::Validator(&judge_unit, "NAME"));
}

void NetworkOptions::add_to(CLI::App& app) {
  app.add_option("--domain", domain, "DDS domain")->check(CLI::Range(0, 232))->capture_default_str();
  add_unit_option(app, unit, "the vehicle's name on the network; becomes the DDS partition");
  app.add_option("--transport", transport, "udp, shm, or default (what Fast DDS or its XML profile says)")
      ->check(host::one_of({"udp", "shm", "default"}))
      ->capture_default_str();
  app.add_option("--interface", interface_address,
                 "network interface to bind to: its name or IPv4 address; 'any' for every interface")
      ->transform(CLI::Validator(&to_address, "NAME|ADDRESS"))
      ->capture_default_str();
  app.add_option("--security", security, "folder of keys made by deploy/security/make-keys; absent: no security")
      ->check(CLI::ExistingDirectory);
  app.add_option("--peer", peers, "IPv4 address of a host of the set; once for each: discovery without multicast")
      ->check(CLI::ValidIPV4);
  app.add_option("--discovery-server", discovery_server, "ADDRESS:PORT of a Fast DDS discovery server (id 0)")
      ->excludes("--peer");
}

std::vector<std::string> NetworkOptions::as_arguments() const {
  std::vector<std::string> arguments{"--domain", std::to_string(domain), "--transport",
                                     transport,  "--interface",          interface_address};
  if (!unit.empty()) arguments.insert(arguments.end(), {"--unit", unit});
  for (const std::string& peer : peers) arguments.insert(arguments.end(), {"--peer", peer});
  if (!discovery_server.empty()) arguments.insert(arguments.end(), {"--discovery-server", discovery_server});
  if (!security.empty()) arguments.insert(arguments.end(), {"--security", security});
  return arguments;
}

std::string NetworkOptions::words() const {
  return "domain " + std::to_string(domain) + (unit.empty() ? ", no unit" : ", unit '" + unit + "'") + ", interface " +
         interface_address;
}

void ClockOptions::add_to(CLI::App& app) {
  app.add_option("--clock", mode, "real_time or lockstep, instead of what the scenario says")
      ->check(host::one_of({"real_time", "lockstep"}));
  app.add_option("--rate", rate, "sim seconds per second, instead of what the scenario says")
      ->check(CLI::Range(kMinRate, kMaxRate));
  app.add_flag("--paused", paused, "wait for 'inslab resume' or 'inslab step' before the first sample");
}

std::vector<std::string> ClockOptions::as_arguments() const {
  std::vector<std::string> arguments;
  if (!mode.empty()) arguments.insert(arguments.end(), {"--clock", mode});
  if (rate > 0.0) arguments.insert(arguments.end(), {"--rate", std::to_string(rate)});
  if (paused) arguments.emplace_back("--paused");
  return arguments;
}

namespace {

const CLI::Validator is_run_id(
    [](std::string& text) {
      return host::run_id_of(text) ? std::string() : "'" + text + "' is no run id; expected 32 hexadecimal digits";
    },
    "ID");

}  // namespace

std::optional<int> parse(const char* name, const char* purpose, const ServiceTraits& traits, int argc, char** argv,
                         ServiceOptions& options) {
  CLI::App app(purpose, name);
  app.add_option("--scenario", options.scenario, "scenario file (JSON)")->required();
  options.network.add_to(app);
  if (traits.has_sensor) app.add_option("--sensor", options.sensor, "number of the sensor in the scenario");
  if (traits.has_log) {
    app.add_option("--log", options.log_file, "file to write; default runs/NAME-TIME.mcap");
    app.add_flag("--overwrite", options.overwrites, "write the log in place of a file that is there");
    app.add_option("--go-on", options.go_on,
                   "run id: a logger was killed in this run; go on with its log, even when the run is over meanwhile")
        ->check(is_run_id);
  }
  if (!traits.makes_truth) {
    app.add_option("--state", options.state_folder,
                   "folder for what this service needs to go on when it is killed and started again; default: inslab "
                   "in the user's runtime folder");
  }
  if (traits.makes_truth) options.clock.add_to(app);
  std::string run;
  app.add_option(
         "--run", run,
         "id of the one run to take part in: 32 hexadecimal digits. Who gives it has seen to it that nobody else "
         "has this place; without it the service looks around first")
      ->check(is_run_id);
  app.add_option("--log-level", options.log_level, "debug, info, warn or error")
      ->check(host::one_of({"debug", "info", "warn", "error"}))
      ->capture_default_str();
  app.add_flag("--check", options.only_checks, "say whether the options and the scenario can be used; start nothing");
  host::expect_finite_numbers(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    std::cerr << name << ": " << text::shown(error.what()) << "\n" << name << " --help says what there is\n";
    return host::kBadInput;
  }
  if (!run.empty()) options.run_id = *host::run_id_of(run);
  return std::nullopt;
}

}  // namespace inslab::service
