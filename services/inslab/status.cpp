#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service.hpp"
#include "app/service_names.hpp"
#include "dds/reader.hpp"
#include "services/inslab/commands.hpp"

namespace inslab::cli {

namespace {

struct StatusOptions {
  std::string scenario;
  double wait_s = 2.2;
  app::NetworkOptions network;
};

using ServiceKey = std::pair<std::string, std::uint32_t>;

/// Hears the heartbeats for a while.
class Listener {
 public:
  explicit Listener(const app::NetworkOptions& network)
      : participant_(app::participant_options(network, "inslab-status")),
        services_reader_(participant_, dds::topics::service_status(),
                         [this](const ServiceStatus& status, const dds::SampleOrigin&) {
                           const std::lock_guard<std::mutex> lock(mutex_);
                           services_[{status.service, status.sensor_number}] = {status, app::monotonic_now()};
                         }),
        status_reader_(participant_, dds::topics::sim_status(),
                       [this](const SimStatus& status, const dds::SampleOrigin&) {
                         const std::lock_guard<std::mutex> lock(mutex_);
                         run_ = status;
                       }),
        vehicle_reader_(participant_, dds::topics::vehicle_link(),
                        [this](const VehicleLink& link, const dds::SampleOrigin&) {
                          const std::lock_guard<std::mutex> lock(mutex_);
                          vehicle_ = link;
                        }) {}

  struct Heard {
    ServiceStatus status;
    time::Nanoseconds at;
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
  dds::Participant participant_;
  mutable std::mutex mutex_;
  std::map<ServiceKey, Heard> services_;
  std::optional<SimStatus> run_;
  std::optional<VehicleLink> vehicle_;
  dds::Reader<ServiceStatus> services_reader_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<VehicleLink> vehicle_reader_;
};

void print_service(const ServiceStatus& status) {
  fmt::print("{:<28}{:>7}  {:<10}{:>10.3f}{:>9}{:>8.1f}  {}\n", status.service, status.sensor_number,
             enum_name(status.state), static_cast<double>(status.sim_time_ns) * 1e-9, status.pid,
             static_cast<double>(status.rss_bytes) * 1e-6, status.message);
}

/// A service that was not heard within the wait, which holds at least two heartbeats, is missing, whatever DDS thinks
/// of its lease.
int status(const StatusOptions& options) {
  std::vector<ServiceKey> expected{{app::kTrajectoryServer, 0u}};
  if (options.scenario.empty()) {
    for (const char* name : {app::kImuInjector, app::kGnssEmulator, app::kTruthLogger}) expected.emplace_back(name, 0u);
  } else {
    for (const ServiceKey& key : app::required_services(scenario::load(options.scenario))) expected.push_back(key);
  }
  const Listener listener(options.network);
  const time::Nanoseconds begun = app::monotonic_now();
  std::this_thread::sleep_for(time::from_seconds(options.wait_s));

  auto heard = listener.services();
  // What came in the first moments may be the latched word of a service that has died since.
  const time::Nanoseconds latched_until = begun + time::from_seconds(options.wait_s - 1.5);
  for (auto it = heard.begin(); it != heard.end();) {
    it = it->second.at < latched_until ? heard.erase(it) : std::next(it);
  }
  if (const auto run = listener.run()) {
    fmt::print("run: {} {} at {:.3f} s, {} truth samples, {} journal entries, {} overruns, largest lag {:.3f} ms {}\n",
               run->scenario, enum_name(run->state), static_cast<double>(run->sim_time_ns) * 1e-9, run->truth_samples,
               run->journal_entries, run->overruns, run->lag_max_s * 1e3, run->message);
  } else {
    fmt::print("run: no trajectory server was heard\n");
  }
  if (const auto link = listener.vehicle()) {
    fmt::print("vehicle: {} states received, {} used; {} missing, {} late, {} refused; {} truth samples extrapolated\n",
               link->received, link->used, link->missing, link->late, link->refused, link->truth_samples_extrapolated);
  }
  fmt::print("{:<28}{:>7}  {:<10}{:>10}{:>9}{:>8}  {}\n", "service", "sensor", "state", "sim s", "pid", "RSS MB",
             "message");
  for (const auto& [key, entry] : heard) print_service(entry.status);
  bool complete = true;
  for (const ServiceKey& key : expected) {
    if (heard.count(key) > 0) continue;
    complete = false;
    fmt::print("{:<28}{:>7}  MISSING\n", key.first, key.second);
  }
  return complete ? app::kOk : app::kFailed;
}

}  // namespace

void add_status(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<StatusOptions>();
  CLI::App* command = app.add_subcommand("status", "Show the services of a running set and who is missing");
  command->add_option("scenario", options->scenario, "scenario file: expect its services; absent: one of each");
  command->add_option("--wait", options->wait_s, "seconds to listen")
      ->check(CLI::Range(2.0, 60.0))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] { action = [options] { return status(*options); }; });
}

}  // namespace inslab::cli
