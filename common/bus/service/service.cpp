#include "inslab/bus/service/service.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>

#include "inslab/bus/service/clock_override.hpp"
#include "inslab/bus/service/scenario_hash.hpp"
#include "inslab/bus/service/set_members.hpp"
#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

namespace {

void set_up_logging(const char* name, const std::string& level) {
  spdlog::set_default_logger(spdlog::stderr_color_mt(name));
  spdlog::set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  spdlog::set_level(spdlog::level::from_str(level));
}

void warn_of_environment() {
  const char* server = std::getenv("ROS_DISCOVERY_SERVER");
  if (server != nullptr && *server != '\0') {
    spdlog::warn("ROS_DISCOVERY_SERVER={} is set: peers that use simple discovery will not see this process", server);
  }
}

}  // namespace

dds::ParticipantOptions participant_options(const NetworkOptions& network, const std::string& name) {
  dds::ParticipantOptions options;
  options.name = name;
  options.domain = network.domain;
  options.unit = network.unit;
  options.transport = network.transport == "shm"       ? dds::Transport::Shm
                      : network.transport == "default" ? dds::Transport::Default
                                                       : dds::Transport::Udp;
  options.interface_address = network.interface_address == "any" ? "" : network.interface_address;
  options.security = network.security;
  options.peers = network.peers;
  options.discovery_server = network.discovery_server;
  options.role = catalog::security_identity(name);
  return options;
}

dds::ParticipantOptions participant_options(const NetworkOptions& network, const streams::Identity& identity) {
  dds::ParticipantOptions options = participant_options(network, identity.service);
  options.user_data = streams::announced(identity);
  return options;
}

streams::Identity identity_of(const std::string& service, const ServiceOptions& options,
                              const scenario::LoadedScenario& scenario) {
  streams::Identity identity;
  identity.service = service;
  identity.sensor_number = options.sensor;
  identity.unit = options.network.unit;
  identity.host = host::host_name();
  identity.process_space = host::process_space();
  identity.pid = host::process_id();
  identity.started_ticks = host::started_ticks(identity.pid).value_or(0);
  identity.since_realtime_ns = host::realtime_now().count();
  identity.version = INSLAB_VERSION;
  identity.scenario = scenario.scenario.name;
  identity.scenario_hash = scenario_hash(scenario);
  identity.run_id = options.run_id;
  return identity;
}

Context::Context(streams::Identity identity, ServiceOptions options, scenario::LoadedScenario scenario)
    : identity_(std::move(identity)),
      options_(std::move(options)),
      scenario_(std::move(scenario)),
      participant_(participant_options(options_.network, identity_)) {}

int run_service(const char* name, const char* purpose, const ServiceTraits& traits, int argc, char** argv,
                const std::function<int(Context&)>& body) {
  ServiceOptions options;
  if (const auto exit_code = parse(name, purpose, traits, argc, argv, options)) return *exit_code;
  set_up_logging(name, options.log_level);
  host::install_signal_handlers();
  warn_of_environment();
  try {
    scenario::LoadedScenario loaded =
        scenario::load(options.scenario, options.network.unit,
                       traits.makes_truth ? scenario::TrajectoryRows::Read : scenario::TrajectoryRows::LeaveOut);
    const streams::Identity identity = identity_of(name, options, loaded);  // by what the files say
    override_clock(options.clock, loaded);
    if (options.only_checks) return host::kOk;
    Context context(identity, options, std::move(loaded));
    // Whoever starts services of one run has looked before.
    if (options.run_id == RunId{}) look_around(context.participant(), identity);
    return body(context);
  } catch (const json::Error& error) {
    spdlog::error("{}", text::shown_lines(error.what()));
    return host::kBadInput;
  } catch (const PlaceTaken& taken) {
    spdlog::error("{}", text::shown_lines(taken.what()));
    return host::kBadInput;
  } catch (const files::OutputRefused& refused) {
    spdlog::error("{}", text::shown_lines(refused.what()));
    return host::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", text::shown_lines(error.what()));
    return host::kFailed;
  }
}

}  // namespace inslab::service
