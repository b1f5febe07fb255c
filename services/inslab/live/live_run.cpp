#include "inslab/services/inslab/live/live_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/service/checkpoint.hpp"
#include "inslab/bus/service/set_members.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::live {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// This process, as the one that has the set, with a run of its own. What proves to others that they have the same
/// scenario is what its files say, as each service reads them: the clock of the loaded one may be the command line's.
streams::Identity identity_for(const RunOptions& options) {
  service::ServiceOptions own;
  own.network = options.network;
  own.run_id = host::random_run_id();
  return service::identity_of(
      "inslab-run", own, scenario::load(options.scenario, options.network.unit, scenario::TrajectoryRows::LeaveOut));
}

bool in_progress(const SimStatus& status) {
  return status.state == RunState::Running || status.state == RunState::Paused;
}

}  // namespace

std::string obstacle_to(const RunOptions& options, const scenario::LoadedScenario& loaded) {
  if (const auto& app = loaded.scenario.reference_nav) (void)navigation::setup_for(loaded, *app);
  constexpr int kThisOneAndTheTrajectoryServer = 2;
  const auto services = static_cast<int>(scenario::required_services(loaded).size());
  const std::string shortage = dds::shared_memory_shortage(service::participant_options(options.network, "inslab-run"),
                                                           services + kThisOneAndTheTrajectoryServer);
  return shortage.empty() ? "" : "--transport " + options.network.transport + ": " + shortage;
}

LiveRun::LiveRun(const RunOptions& options, const scenario::LoadedScenario& loaded)
    : options_(options),
      loaded_(loaded),
      identity_(identity_for(options)),
      participant_(service::participant_options(options.network, identity_)),
      client_(participant_, identity_),
      service_status_(
          participant_, dds::topics::service_status(),
          client_.writers().only(dds::topics::service_status(),
                                 [this](const ServiceStatus& status, const dds::SampleOrigin&) { note(status); })),
      lockstep_(options.clock.mode.empty() ? loaded.scenario.clock.mode == ClockMode::Lockstep
                                           : options.clock.mode == "lockstep"),
      holds_the_start_(lockstep_ && !loaded.swaps.empty()) {
  std::vector<scenario::ServiceKey> places = scenario::required_services(loaded_);
  places.emplace_back(catalog::kTrajectoryServer, 0u);
  places.push_back(identity_.role());
  service::look_around(participant_, identity_, [&places](const streams::Identity& other) {
    return std::find(places.begin(), places.end(), other.role()) != places.end();
  });
}

void LiveRun::start_services() {
  if (!options_.network.security.empty()) std::fprintf(stderr, "starts the services of a secured set one by one\n");
  std::vector<std::string> common{"--scenario",  options_.scenario,
                                  "--log-level", options_.verbose ? "info" : "warn",
                                  "--run",       host::run_id_text(identity_.run_id)};
  const std::vector<std::string> network = options_.network.as_arguments();
  common.insert(common.end(), network.begin(), network.end());
  const auto with = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), more);
    if (!options_.state_folder.empty()) arguments.insert(arguments.end(), {"--state", options_.state_folder});
    return arguments;
  };
  const auto start = [this](const char* program, const std::vector<std::string>& arguments) {
    children_.start(program, arguments);
    // Fast DDS 2.9.1 leaves pairs unauthenticated for good when many participants shake hands at once: of 8 secured
    // sets started at once on a busy machine 5 never became ready, of 10 started one by one all did.
    if (!options_.network.security.empty()) std::this_thread::sleep_for(milliseconds(700));
  };
  start(catalog::kTruthLogger, with({"--log", options_.log_file, "--overwrite"}));  // judged before, by this process
  for_each_sensor(loaded_, [&](auto kind, const auto& sensor) {
    start(decltype(kind)::type::service, with({"--sensor", std::to_string(sensor.number)}));
  });
  if (loaded_.scenario.reference_nav) start(catalog::kReferenceNav, with({}));
  service::ClockOptions clock = options_.clock;
  clock.paused = clock.paused || holds_the_start_;
  const std::vector<std::string> arguments = clock.as_arguments();
  common.insert(common.end(), arguments.begin(), arguments.end());
  children_.start(catalog::kTrajectoryServer, common);
}

void LiveRun::follow(const std::function<void()>& meanwhile) {
  Progress progress(loaded_.scenario.name, time::from_seconds(loaded_.scenario.duration_s));
  while (!children_.all_ended()) {
    children_.poll();
    meanwhile();
    if (!told_to_stop_) restart_killed(progress);
    const auto status = client_.status();
    if (!told_to_stop_ && status && in_progress(*status)) note_early_ends(progress);
    if (status) {
      progress.show(time::Nanoseconds(status->sim_time_ns));
      if (has_ended(status->state)) {
        if (!run_ended_) run_ended_ = host::monotonic_now();
      } else {
        tell_wait(progress, status->message);
      }
      send_due_swaps(*status);
    }
    if (host::shutdown_requested() && !told_to_stop_) stop(seconds(10));
    // In lockstep nobody gives credit for one who left; the trajectory server ends the run where that one said why.
    const bool stands = lockstep_ && left_at_ && host::monotonic_now() - *left_at_ > seconds(5);
    if (stands && !told_to_stop_ && status && in_progress(*status)) stop(seconds(15));
    if (!told_to_stop_ && children_.failure() && (!status || status->state == RunState::Waiting)) {
      told_to_stop_ = true;  // the barrier will not open without it
      stop_deadline_ = host::monotonic_now() + seconds(10);
      children_.terminate();
    }
    if (children_.has_ended(catalog::kTrajectoryServer) && !stop_deadline_) {
      stop_deadline_ = host::monotonic_now() + seconds(15);
      // Without the clock nobody ends by itself.
      if (children_.failure() && !told_to_stop_) children_.terminate();
    }
    if (run_ended_ && host::monotonic_now() - *run_ended_ > seconds(2)) tell_wait(progress, words_of_rest());
    if (stop_deadline_ && host::monotonic_now() > *stop_deadline_) return;
    std::this_thread::sleep_for(milliseconds(20));
  }
  if (const auto status = client_.status()) service::remove_checkpoints(options_.state_folder, status->run_id);
}

void LiveRun::stop(seconds patience) {
  told_to_stop_ = true;
  stop_deadline_ = host::monotonic_now() + patience;
  if (!client_.connected() || !client_.send({1, CommandKind::Stop, 0.0})) children_.terminate();
}

std::optional<std::string> LiveRun::failure() const {
  if (host::shutdown_requested()) return "stopped by a signal";
  if (given_up_) return given_up_;
  if (!children_.all_ended()) return "a service did not end";
  const auto status = client_.status();
  if (status && status->state == RunState::Fault && !status->message.empty()) {
    return "the run ended as a fault: " + status->message;
  }
  if (!early_ends_.empty()) return early_ends_.front();
  if (next_swap_ < loaded_.swaps.size()) return "the run ended before all swaps were sent";
  auto failure = children_.failure();
  if (failure) *failure += reason();
  return failure;
}

/// What the set itself says of what went wrong, after a colon; empty when it says nothing.
std::string LiveRun::reason() const {
  const auto status = client_.status();
  if (status && status->state == RunState::Fault && !status->message.empty()) return ": " + status->message;
  const std::lock_guard<std::mutex> lock(mutex_);
  return first_fault_.empty() ? "" : ": " + first_fault_;
}

void LiveRun::note(const ServiceStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  said_[{status.service, status.sensor_number}] = status.state;
  if (status.state == ServiceState::Fault && first_fault_.empty()) first_fault_ = status.message;
}

/// Who has not ended though the run has.
std::string LiveRun::words_of_rest() const {
  std::string names;
  for (const auto& [program, pid] : children_.running()) names += (names.empty() ? "" : ", ") + program;
  return names.empty() ? "" : "waits for the end of " + names;
}

/// What the trajectory server says it waits for, when it is news.
void LiveRun::tell_wait(const Progress& progress, const std::string& message) {
  if (message.empty() || message == told_wait_) return;
  told_wait_ = message;
  progress.say(message);
}

/// A service that ends by itself, or by a signal that it obeys, while the run goes on leaves the run without it.
void LiveRun::note_early_ends(const Progress& progress) {
  if (children_.has_ended(catalog::kTrajectoryServer)) return;  // the run is at its end: everybody goes
  for (const std::string& words : children_.newly_ended()) {
    early_ends_.push_back(words + " in mid-run" + when() + ": what it would have sent is missing");
    if (!left_at_) left_at_ = host::monotonic_now();
    progress.say(early_ends_.back());
  }
}

std::string LiveRun::when() const {
  const auto status = client_.status();
  if (!status || status->state == RunState::Waiting) return ", before the run began";
  return fmt::format(", at about {:.3f} s of sim time", time::to_seconds(status->sim_time_ns));
}

/// Whether a service has said that its work is done, and the logger has heard it: then it was on its way out. The
/// trajectory server could not say it again.
bool LiveRun::has_done(const ChildProcesses::Ended& ended) const {
  if (ended.program == catalog::kTruthLogger) return false;  // it says so before its log is closed
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto said = [this](const scenario::ServiceKey& service, ServiceState state) {
    const auto found = said_.find(service);
    return found != said_.end() && found->second == state;
  };
  const scenario::ServiceKey logger{catalog::kTruthLogger, 0u};
  const bool is_heard = children_.has_ended(catalog::kTruthLogger) || said(logger, ServiceState::Finished) ||
                        said(logger, ServiceState::Fault) || ended.program == catalog::kTrajectoryServer;
  return said({ended.program, ended.sensor}, ServiceState::Finished) && is_heard;
}

bool LiveRun::starts_again(ChildProcesses::Ended& ended) {
  const auto status = client_.status();
  if (has_done(ended)) {
    children_.forgive(ended.program, ended.sensor);
    return false;
  }
  if (ended.too_often) {
    given_up_ = ended.words + when() + ", and again and again within seconds of its start: it was not started again";
    return false;
  }
  if (!status || status->state == RunState::Waiting) return true;
  if (ended.program == catalog::kTrajectoryServer) {
    given_up_ = ended.words + when() + ": it is the run's clock, and what follows is missing";
    return false;
  }
  if (ended.program == catalog::kTruthLogger) {
    auto& words = ended.arguments;
    if (std::find(words.begin(), words.end(), "--go-on") == words.end()) {
      words.insert(words.end(), {"--go-on", host::run_id_text(status->run_id)});
    }
    return true;
  }
  return !children_.has_ended(catalog::kTrajectoryServer);
}

void LiveRun::restart_killed(const Progress& progress) {
  for (const std::string& line :
       children_.restart_killed([this](ChildProcesses::Ended& ended) { return starts_again(ended); })) {
    restarts_.push_back(line + when());
    progress.say(restarts_.back());
  }
}

/// A request goes out a second before it takes effect: ample for the journal, and still while the run goes on. In
/// lockstep a second holds minutes of sim time, so all of them go out while the run is still held at its start.
void LiveRun::send_due_swaps(const SimStatus& status) {
  const auto lead_ns = static_cast<std::int64_t>(1e9 * std::max(1.0, status.rate));
  while (next_swap_ < loaded_.swaps.size() && client_.connected()) {
    const catalog::AnyProfile& request = loaded_.swaps[next_swap_];
    const bool early = !lockstep_ && catalog::request_of(request).apply_at_ns > status.sim_time_ns + lead_ns;
    if (early || !client_.send(request)) return;
    ++next_swap_;
  }
  const bool journalled = status.journal_entries >= loaded_.swaps.size();
  if (holds_the_start_ && !released_ && !options_.clock.paused && journalled) {
    released_ = client_.send({1, CommandKind::Resume, 0.0});
  }
}

}  // namespace inslab::live
