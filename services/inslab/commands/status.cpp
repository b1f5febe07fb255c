#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/status_table.hpp"

namespace inslab::cli {

namespace {

struct StatusOptions {
  std::string scenario;
  double wait_s = 2.2;
  bool once = false;
  app::NetworkOptions network;
};

using app::ServiceKey;

/// Hears the heartbeats for a while.
class Listener {
 public:
  explicit Listener(const app::NetworkOptions& network)
      : participant_(app::participant_options(network, "inslab-status")),
        writers_(participant_.peers(), participant_.key(), of_any_set(network)),
        services_reader_(participant_, dds::topics::service_status(),
                         [this](const ServiceStatus& status, const dds::SampleOrigin&) {
                           const std::lock_guard<std::mutex> lock(mutex_);
                           Heard& heard = services_[{status.service, status.sensor_number}];
                           heard = {status, app::monotonic_now(), std::move(heard.status)};
                         }),
        status_reader_(participant_, dds::topics::sim_status(),
                       writers_.only(dds::topics::sim_status(),
                                     [this](const SimStatus& status, const dds::SampleOrigin&) {
                                       const std::lock_guard<std::mutex> lock(mutex_);
                                       run_ = status;
                                     })),
        vehicle_reader_(
            participant_, dds::topics::vehicle_link(),
            writers_.only(dds::topics::vehicle_link(), [this](const VehicleLink& link, const dds::SampleOrigin&) {
              const std::lock_guard<std::mutex> lock(mutex_);
              vehicle_ = link;
            })) {}

  struct Heard {
    ServiceStatus status;
    time::Nanoseconds at;    ///< CLOCK_MONOTONIC
    ServiceStatus previous;  ///< the heartbeat before
  };
  std::map<ServiceKey, Heard> services() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return services_;
  }
  std::optional<VehicleLink> vehicle() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return vehicle_;
  }
  std::optional<SimStatus> run() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return run_;
  }

 private:
  static app::Identity of_any_set(const app::NetworkOptions& network) {
    app::Identity own;
    own.service = "inslab-status";
    own.unit = network.unit;
    return own;
  }

  dds::Participant participant_;
  app::Writers writers_;
  mutable std::mutex mutex_;
  std::map<ServiceKey, Heard> services_;
  std::optional<SimStatus> run_;
  std::optional<VehicleLink> vehicle_;
  dds::Reader<ServiceStatus> services_reader_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<VehicleLink> vehicle_reader_;
};

/// Those heard after `since`. One that was not heard for as long as two heartbeats take is missing, whatever DDS thinks
/// of its lease.
std::vector<Heartbeats> living(const Listener& listener, time::Nanoseconds since) {
  std::vector<Heartbeats> services;
  for (const auto& [key, heard] : listener.services()) {
    if (heard.at >= since) services.push_back({heard.status, heard.previous});
  }
  return services;
}

std::vector<ServiceKey> missing_of(const std::vector<ServiceKey>& expected, const std::vector<Heartbeats>& services) {
  std::vector<ServiceKey> missing;
  for (const ServiceKey& key : expected) {
    const bool lives = std::any_of(services.begin(), services.end(), [&key](const Heartbeats& service) {
      return ServiceKey{service.last.service, service.last.sensor_number} == key;
    });
    if (!lives) missing.push_back(key);
  }
  return missing;
}

std::vector<ServiceKey> expected_services(const std::string& scenario) {
  std::vector<ServiceKey> expected{{app::kTrajectoryServer, 0u}};
  if (scenario.empty()) {
    for_each(catalog::SensorKinds{},
             [&expected](auto kind) { expected.emplace_back(decltype(kind)::type::service, 0u); });
    expected.emplace_back(app::kTruthLogger, 0u);
  } else {
    for (const ServiceKey& key : app::required_services(scenario::load(scenario))) expected.push_back(key);
  }
  return expected;
}

int show_once(const StatusOptions& options, const std::vector<ServiceKey>& expected) {
  if (options.wait_s > 2.0) fmt::print(stderr, "listens for {:g} s on {}\n", options.wait_s, options.network.words());
  const Listener listener(options.network);
  const time::Nanoseconds begun = app::monotonic_now();
  listen_for(options.wait_s);
  // What came in the first moments may be the latched word of a service that has died since.
  const time::Nanoseconds since = begun + time::from_seconds(options.wait_s - 1.5);
  const std::vector<Heartbeats> services = living(listener, since);
  const std::vector<ServiceKey> missing = missing_of(expected, services);
  fmt::print("{}{}", run_table(listener.run(), listener.vehicle(), options.network.words()),
             service_table(services, missing));
  return missing.empty() ? app::kOk : app::kFailed;
}

/// The table in place, twice a second, until the run has ended or Ctrl-C.
int show_live(const StatusOptions& options, const std::vector<ServiceKey>& expected) {
  const app::OwnEnding leaves_the_domain(app::OwnEnding::Then::CodeStands);
  const Listener listener(options.network);
  bool complete = false;
  while (!app::shutdown_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const time::Nanoseconds since = app::monotonic_now() - time::from_seconds(options.wait_s);
    const std::vector<Heartbeats> services = living(listener, since);
    const std::vector<ServiceKey> missing = missing_of(expected, services);
    complete = missing.empty();
    fmt::print("\033[H\033[J{}{}{}", run_table(listener.run(), listener.vehicle(), options.network.words()),
               service_table(services, missing), stream_table(services));
    std::fflush(stdout);
    const auto run = listener.run();
    if (run && has_ended(run->state)) break;
  }
  return complete ? app::kOk : app::kFailed;
}

int status(const StatusOptions& options) {
  const std::vector<ServiceKey> expected = expected_services(options.scenario);
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

}  // namespace inslab::cli
