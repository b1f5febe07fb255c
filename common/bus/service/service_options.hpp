#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace CLI {
class App;
}

namespace inslab::service {

/// Adds --unit, which takes what foundation/fields/unit_name.hpp calls a unit's name, or nothing.
void add_unit_option(CLI::App& app, std::string& unit, const std::string& meaning);

/// Where on the network: the same options on every program.
struct NetworkOptions {
  std::uint32_t domain = 0;
  std::string unit;
  std::string transport = "udp";
  std::string interface_address = "127.0.0.1";
  std::string security;
  std::vector<std::string> peers;
  std::string discovery_server;

  /// Adds --domain, --unit, --transport, --interface, --security, --peer and --discovery-server.
  void add_to(CLI::App& app);
  /// The same as arguments for another program.
  std::vector<std::string> as_arguments() const;
  /// "domain 7, unit 'truck', interface 127.0.0.1": where somebody was looked for, for messages.
  std::string words() const;
};

/// What sets the pace of a run, where it is to be another one than the scenario says.
struct ClockOptions {
  std::string mode;
  double rate = 0.0;
  bool paused = false;

  /// Adds --clock, --rate and --paused.
  void add_to(CLI::App& app);
  /// The same as arguments for another program.
  std::vector<std::string> as_arguments() const;
};

/// The command line of a service.
struct ServiceOptions {
  std::string scenario;
  NetworkOptions network;
  std::uint32_t sensor = 0;
  std::string log_file;
  bool overwrites = false;   ///< the log may take the place of a file that is there
  std::string go_on;         ///< run id: the log is that of a logger that was killed in this run; empty: find out
  std::string state_folder;  ///< empty: the user's own, see bus/service/checkpoint.hpp
  ClockOptions clock;
  RunId run_id;  ///< the one run to take part in; zero: whichever is there
  std::string log_level = "info";
  bool only_checks = false;  ///< whether this and the scenario can be used is said, and nothing started
};

/// Which options a service has besides --scenario and those of the network.
struct ServiceTraits {
  bool has_sensor = false;
  bool has_log = false;
  bool makes_truth = false;  ///< it has the clock and the trajectory
};

/// Parses the command line; an exit code when there is nothing more to do (help, or an error that has been printed).
std::optional<int> parse(const char* name, const char* purpose, const ServiceTraits& traits, int argc, char** argv,
                         ServiceOptions& options);

}  // namespace inslab::service
