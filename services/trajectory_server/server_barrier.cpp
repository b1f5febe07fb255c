// What ServerOnBus does before the first sample: it waits for everybody, and finds out whether it may run at all.

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

#include "inslab/bus/service/set_members.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/trajectory_server/server_on_bus.hpp"

namespace inslab::trajectory_server {

using host::monotonic_now;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// What services need to start and to find each other is no wait worth telling.
constexpr time::Nanoseconds kTimeToStart = milliseconds(800);

bool waits_for_app(const std::string& message) { return message.rfind(scenario::kWaitsForApp, 0) == 0; }

void append(std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; }

}  // namespace

/// The services that are not ready by themselves; one that waits for the app alone is not among them.
std::string ServerOnBus::missing_services() const {
  std::string missing;
  for (const auto& [service, number] : scenario::required_services(scenario_)) {
    const auto found = services_.find({service, number});
    const std::string message = found == services_.end() ? "" : found->second.message;
    const bool ready = found != services_.end() && found->second.state == ServiceState::Ready;
    if (ready || waits_for_app(message)) continue;
    append(missing, service + " (sensor " + std::to_string(number) + (message.empty() ? "" : ": " + message) + ")");
  }
  return missing;
}

/// What the scenario demands of others: readers of streams, solutions, states of a vehicle.
std::string ServerOnBus::missing_apps() const {
  const std::size_t prefix = std::strlen(scenario::kWaitsForApp);
  std::set<std::string> wanted;  // several services may wait for the same
  for (const auto& [key, heard] : services_) {
    const bool ended = heard.state == ServiceState::Finished || heard.state == ServiceState::Fault;
    if (!ended && waits_for_app(heard.message)) wanted.insert(heard.message.substr(prefix));
  }
  if (const std::string readers = truth_.missing_readers(); waits_for_app(readers)) {
    wanted.insert(readers.substr(prefix));
  }
  if (vehicle_ && !vehicle_->connected()) wanted.insert("a writer of inslab/vehicle_state");
  std::string missing;
  for (const std::string& what : wanted) append(missing, what);
  return missing.empty() ? "" : "an app: " + missing + " on " + context_.options().network.words();
}

/// Names who is not there yet; empty when everybody is.
std::string ServerOnBus::missing_peers() const {
  if (const std::string services = missing_services(); !services.empty()) return services;
  if (const std::string apps = missing_apps(); !apps.empty()) return apps;
  return truth_.missing_readers().empty() ? "" : "the services' readers of " + truth_.topic();
}

/// A service of this scenario that was given something else; empty when there is none. One that comes now hears of this
/// server, and leaves by itself: only one that stays counts.
std::string ServerOnBus::stranger_among_services() {
  constexpr time::Nanoseconds kTimeToLeave = milliseconds(1500);
  const auto required = scenario::required_services(scenario_);
  for (const streams::Identity& member : service::members_of(context_.participant(), context_.identity().unit)) {
    if (std::find(required.begin(), required.end(), member.role()) == required.end()) continue;
    const std::string why = streams::difference(context_.identity(), member);
    if (why.empty()) continue;
    if (!stranger_since_) stranger_since_ = monotonic_now();
    if (monotonic_now() - *stranger_since_ < kTimeToLeave) return "";
    return streams::words_of(member) + " does not belong to this trajectory server's run: " + why;
  }
  stranger_since_.reset();
  return "";
}

/// An app that was built with other types than ours never matches, and would wait for ever without a word.
void ServerOnBus::warn_of_other_versions() {
  for (const dds::OtherVersion& other : context_.participant().take_other_versions()) {
    if (!told_of_version_.insert(other.participant).second) continue;
    const auto peer = context_.participant().peers().find(other.participant);
    spdlog::warn("{} {} {} as {}: it was built with another version of the types and does not match; this set has {}*",
                 peer ? dds::words_of(*peer) : "a participant that has left", other.is_writer ? "writes" : "reads",
                 other.topic, other.type, catalog::kModule);
  }
}

/// Before the first sample: the exit code when services are in a run whose server is gone.
std::optional<int> ServerOnBus::end_run_without_server() {
  const ServiceStatus* orphan = others_.orphan(monotonic_now());
  if (orphan == nullptr) return std::nullopt;
  return end_run_of(*orphan);
}

/// Everybody in the run of a server that is gone ends it as a fault.
int ServerOnBus::end_run_of(const ServiceStatus& orphan) {
  const std::string reason = "the trajectory server of this run is gone; a run is not gone on with by another one";
  spdlog::error("services are in a run whose trajectory server is gone: it ends as a fault. Start the set again");
  status_.run_id = orphan.run_id;
  status_.state = RunState::Fault;
  status_.message = reason;
  status_.sim_time_ns = orphan.sim_time_ns;
  sim_status_.write(status_);
  sim_status_.wait_for_acknowledgments(seconds(2));
  board_.enter(ServiceState::Fault, reason);
  const time::Nanoseconds deadline = monotonic_now() + seconds(10);
  const auto still_running = [this] {
    return std::any_of(services_.begin(), services_.end(),
                       [](const auto& service) { return service.second.state == ServiceState::Running; });
  };
  while (still_running() && monotonic_now() < deadline && !host::shutdown_requested()) {
    handle_messages(milliseconds(50));
    board_.tick();
  }
  board_.flush(seconds(2));
  return host::kFailed;
}

/// Into the status and, when it is news, into the log.
void ServerOnBus::tell_wait(const std::string& names) {
  const std::string before = status_.message;
  say("waits for " + names);
  if (status_.message != before) spdlog::info("{}", status_.message);
}

/// The barrier before the first sample. False when it timed out or a signal came.
bool ServerOnBus::wait_until_ready() {
  const double timeout_s = scenario_.scenario.clock.ready_timeout_s;
  const auto begun = monotonic_now();
  const auto deadline = begun + time::from_seconds(timeout_s);
  board_.enter(ServiceState::Ready);
  for (std::string names = missing_peers(); !names.empty(); names = missing_peers()) {
    if (host::shutdown_requested() || control_.stop_requested()) return false;
    if (others_.orphan(monotonic_now()) != nullptr) return false;
    if (const std::string stranger = stranger_among_services(); !stranger.empty()) {
      spdlog::error("{}", stranger);
      say(stranger);
      return false;
    }
    if (monotonic_now() > deadline) {
      spdlog::error("not ready after {:g} s: waits for {}", timeout_s, names);
      say("not ready: " + names);
      return false;
    }
    handle_messages(milliseconds(2));
    if (monotonic_now() - begun > kTimeToStart) tell_wait(names);
    report_status();
    board_.tick();
  }
  say("");
  return true;
}

}  // namespace inslab::trajectory_server
