// What ServerOnBus makes of those who follow its truth: who is slow, who has left, who still lacks something at the
// end.

#include <spdlog/spdlog.h>

#include <algorithm>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/trajectory_server/server_on_bus.hpp"

namespace inslab::trajectory_server {

using host::monotonic_now;
using std::chrono::milliseconds;
using std::chrono::seconds;

bool ServerOnBus::clock_stands() const {
  constexpr time::Nanoseconds kPatience = seconds(2);
  return blocked_since_ != time::Nanoseconds(0) && monotonic_now() - blocked_since_ > kPatience;
}

/// Says who holds the clock when no credit has come for a while.
void ServerOnBus::watch_consumers() {
  if (truth_.has_room()) {
    board_.enter(ServiceState::Running);
    return;
  }
  if (blocked_since_ == time::Nanoseconds(0)) blocked_since_ = monotonic_now();
  if (!clock_stands()) return;
  say("waits for " + truth_.slowest_consumer());
  board_.enter(ServiceState::Running, status_.message);
}

/// Why the run cannot go on, as a service of it says; empty when it can. Without one that was told to stop, and without
/// the logger and the navigation app, it goes on; in lockstep nobody who has left gives credit.
std::string ServerOnBus::fault_of_a_service() const {
  if (!fault_heard_) return "";
  for (const auto& [service, number] : scenario::required_services(scenario_)) {
    const auto found = services_.find({service, number});
    if (found == services_.end() || !found->second.is_fault_of_this_run) continue;
    const std::string& message = found->second.message;
    const bool makes_data = catalog::is_of_a_sensor_kind(service);
    const bool was_told = message.rfind(scenario::kEndedBySignal, 0) == 0;
    if (clock_stands() || (makes_data && !was_told)) return service + " " + std::to_string(number) + ": " + message;
  }
  return "";
}

/// Goes on sending again what is asked for until every consumer has everything, or a while has passed: time for one
/// that was killed at the end to be started again and to go on.
void ServerOnBus::serve_stragglers(time::Nanoseconds patience) {
  const auto all_ended = [this] {
    if (run_.log_is_closed()) return true;  // nobody else writes down what comes
    if (status_.clock == ClockMode::Lockstep && truth_.lowest_wanted() < source_->taken()) return false;
    if (!truth_.is_logged()) return false;
    for (const auto& [service, number] : scenario::required_services(scenario_)) {
      if (service == catalog::kTruthLogger) continue;  // it ends after this service
      const auto found = services_.find({service, number});
      if (found == services_.end()) continue;  // the run had not begun
      if (found->second.state != ServiceState::Finished && found->second.state != ServiceState::Fault) return false;
    }
    return true;
  };
  while (!all_ended() && !run_.ended_before(patience, monotonic_now()) && !host::shutdown_requested()) {
    handle_messages(milliseconds(20));
    if (source_->taken() > 0) tell_the_wait_for_the_log();
    board_.tick();
  }
}

void ServerOnBus::tell_the_wait_for_the_log() {
  if (!run_.tells_the_wait(monotonic_now())) return;
  spdlog::info("waits until the logger has closed its log, at most {} s",
               std::chrono::duration_cast<seconds>(streams::kTimeToComeBack).count());
}

/// A logger that was killed at the end hears the last word of this service when it is back.
void ServerOnBus::stay_for_the_log() {
  while (run_.stays_for_the_log(monotonic_now()) && !host::shutdown_requested()) {
    handle_messages(milliseconds(20));
    tell_the_wait_for_the_log();
    board_.tick();
  }
}

}  // namespace inslab::trajectory_server
