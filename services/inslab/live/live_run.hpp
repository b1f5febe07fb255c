#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/inslab/live/child_processes.hpp"
#include "inslab/services/inslab/live/progress.hpp"

namespace inslab::live {

struct RunOptions {
  std::string scenario;
  std::string log_file;
  std::string state_folder;  ///< empty: the services' own default
  service::NetworkOptions network;
  service::ClockOptions clock;
  bool verbose = false;
};

/// What would end the run later without a word, such as shared memory that is too small; empty: nothing is seen. Throws
/// json::Error when the parameters of the scenario's own navigation app cannot be read.
std::string obstacle_to(const RunOptions& options, const scenario::LoadedScenario& loaded);

/// A scenario run live by one process for each service, from start to end. A service that a signal ends is started
/// again, before the run as one that is new, in the middle of it from its checkpoint; not so then the trajectory
/// server, whose end is the run's, and not one that dies again and again within seconds of its start.
class LiveRun {
 public:
  /// Takes the place for a set in the unit. Throws service::PlaceTaken when there is one. Both are used until the end.
  LiveRun(const RunOptions& options, const scenario::LoadedScenario& loaded);

  /// Starts one process for each service of the scenario.
  void start_services();

  /// Sends the scheduled swaps while the run goes on; returns when every process has ended or something went wrong.
  /// `meanwhile` is called every few milliseconds.
  void follow(const std::function<void()>& meanwhile = [] {});

  /// Which service was started again, and when, one line for each time.
  const std::vector<std::string>& restarts() const { return restarts_; }

  /// What went wrong; nothing when nothing did.
  std::optional<std::string> failure() const;

  client::RunClient& client() { return client_; }
  const ChildProcesses& services() const { return children_; }

 private:
  std::string words_of_rest() const;
  void tell_wait(const Progress& progress, const std::string& message);
  void note_early_ends(const Progress& progress);
  void note(const ServiceStatus& status);
  std::string reason() const;
  void restart_killed(const Progress& progress);
  bool starts_again(ChildProcesses::Ended& ended);
  bool has_done(const ChildProcesses::Ended& ended) const;
  std::string when() const;
  void stop(std::chrono::seconds patience);
  void send_due_swaps(const SimStatus& status);

  host::OwnEnding ends_the_services_{host::OwnEnding::Then::CodeStands};  ///< of a signal
  const RunOptions& options_;
  const scenario::LoadedScenario& loaded_;
  streams::Identity identity_;
  dds::Participant participant_;
  client::RunClient client_;
  mutable std::mutex mutex_;
  std::string first_fault_;                            ///< of a service; guarded by mutex_
  std::map<scenario::ServiceKey, ServiceState> said_;  ///< what each service said last; guarded by mutex_
  dds::Reader<ServiceStatus> service_status_;
  std::vector<std::string> restarts_;
  std::optional<std::string> given_up_;       ///< which service is not started again, and why
  std::vector<std::string> early_ends_;       ///< which service left the run, and when
  std::optional<time::Nanoseconds> left_at_;  ///< CLOCK_MONOTONIC, the first of them
  std::string told_wait_;
  ChildProcesses children_;
  bool lockstep_;
  bool holds_the_start_;  ///< until every scheduled swap is in the journal
  bool released_ = false;
  bool told_to_stop_ = false;
  std::size_t next_swap_ = 0;
  std::optional<time::Nanoseconds> stop_deadline_;
  std::optional<time::Nanoseconds> run_ended_;
};

}  // namespace inslab::live
