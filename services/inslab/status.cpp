#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service.hpp"
#include "app/service_names.hpp"
#include "app/shutdown.hpp"
#include "dds/reader.hpp"
#include "services/inslab/commands.hpp"

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
        services_reader_(participant_, dds::topics::service_status(),
                         [this](const ServiceStatus& status, const dds::SampleOrigin&) {
                           const std::lock_guard<std::mutex> lock(mutex_);
                           Heard& heard = services_[{status.service, status.sensor_number}];
                           heard = {status, app::monotonic_now(), std::move(heard.status)};
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
  dds::Participant participant_;
  mutable std::mutex mutex_;
  std::map<ServiceKey, Heard> services_;
  std::optional<SimStatus> run_;
  std::optional<VehicleLink> vehicle_;
  dds::Reader<ServiceStatus> services_reader_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<VehicleLink> vehicle_reader_;
};

void print_run(const Listener& listener) {
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
}

/// The services heard after `since`, and who is missing; true when nobody is. One that was not heard for as long as two
/// heartbeats take is missing, whatever DDS thinks of its lease.
bool print_services(const std::map<ServiceKey, Listener::Heard>& heard, const std::vector<ServiceKey>& expected,
                    time::Nanoseconds since) {
  fmt::print("{:<28}{:>7}  {:<10}{:>10}{:>9}{:>8}  {}\n", "service", "sensor", "state", "sim s", "pid", "RSS MB",
             "message");
  const auto lives = [&](const ServiceKey& key) { return heard.count(key) > 0 && heard.at(key).at >= since; };
  for (const auto& [key, entry] : heard) {
    if (!lives(key)) continue;
    const ServiceStatus& status = entry.status;
    fmt::print("{:<28}{:>7}  {:<10}{:>10.3f}{:>9}{:>8.1f}  {}\n", status.service, status.sensor_number,
               enum_name(status.state), static_cast<double>(status.sim_time_ns) * 1e-9, status.pid,
               static_cast<double>(status.rss_bytes) * 1e-6, status.message);
  }
  bool complete = true;
  for (const ServiceKey& key : expected) {
    if (lives(key)) continue;
    complete = false;
    fmt::print("{:<28}{:>7}  MISSING\n", key.first, key.second);
  }
  return complete;
}

/// What each service counts on its streams; the rate is that between its last two heartbeats.
void print_streams(const std::map<ServiceKey, Listener::Heard>& heard, time::Nanoseconds since) {
  fmt::print("\n{:<28}{:>7}  {:<26}{:<4}{:>12}{:>10}{:>7}{:>10}{:>10}\n", "service", "sensor", "stream", "", "samples",
             "rate Hz", "lost", "p50 ms", "p99 ms");
  for (const auto& [key, entry] : heard) {
    if (entry.at < since) continue;
    const double passed_s = static_cast<double>(entry.status.realtime_ns - entry.previous.realtime_ns) * 1e-9;
    for (const StreamStatus& stream : entry.status.streams) {
      std::string rate = "-";
      for (const StreamStatus& before : entry.previous.streams) {
        if (before.topic != stream.topic || before.direction != stream.direction || passed_s <= 0.0) continue;
        rate = fmt::format("{:.1f}", static_cast<double>(stream.samples - before.samples) / passed_s);
      }
      const bool out = stream.direction == StreamDirection::Out;
      const auto ms = [out](double latency_s) {
        return out || latency_s < 0.0 ? std::string("-") : fmt::format("{:.3f}", latency_s * 1e3);
      };
      fmt::print("{:<28}{:>7}  {:<26}{:<4}{:>12}{:>10}{:>7}{:>10}{:>10}\n", key.first, key.second, stream.topic,
                 out ? "out" : "in", stream.samples, rate, stream.lost, ms(stream.latency_p50_s),
                 ms(stream.latency_p99_s));
    }
  }
}

std::vector<ServiceKey> expected_services(const std::string& scenario) {
  std::vector<ServiceKey> expected{{app::kTrajectoryServer, 0u}};
  if (scenario.empty()) {
    for (const char* name : {app::kImuInjector, app::kGnssEmulator, app::kTruthLogger}) expected.emplace_back(name, 0u);
  } else {
    for (const ServiceKey& key : app::required_services(scenario::load(scenario))) expected.push_back(key);
  }
  return expected;
}

int show_once(const StatusOptions& options, const std::vector<ServiceKey>& expected) {
  const Listener listener(options.network);
  const time::Nanoseconds begun = app::monotonic_now();
  std::this_thread::sleep_for(time::from_seconds(options.wait_s));
  // What came in the first moments may be the latched word of a service that has died since.
  const time::Nanoseconds since = begun + time::from_seconds(options.wait_s - 1.5);
  print_run(listener);
  return print_services(listener.services(), expected, since) ? app::kOk : app::kFailed;
}

/// The table in place, twice a second, until the run has ended or Ctrl-C.
int show_live(const StatusOptions& options, const std::vector<ServiceKey>& expected) {
  app::install_signal_handlers();
  const Listener listener(options.network);
  bool complete = false;
  while (!app::shutdown_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const time::Nanoseconds since = app::monotonic_now() - time::from_seconds(options.wait_s);
    const auto heard = listener.services();
    fmt::print("\033[H\033[J");
    print_run(listener);
    complete = print_services(heard, expected, since);
    print_streams(heard, since);
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
