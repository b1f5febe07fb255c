#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "app/service.hpp"
#include "services/inslab/child_processes.hpp"
#include "services/inslab/progress.hpp"
#include "services/inslab/run_client.hpp"

namespace inslab::cli {

struct RunOptions {
  std::string scenario;
  std::string log_file;
  std::string state_folder;  ///< empty: the services' own default
  app::NetworkOptions network;
  app::ClockOptions clock;
  bool verbose = false;
};

/// A scenario run live by one process for each service, from start to end. A service that a signal ends in the middle
/// of the run is started again and goes on from its checkpoint; not so the trajectory server, whose end is the run's.
class LiveRun {
 public:
  /// Takes the place for a set in the unit. Throws app::PlaceTaken when there is one. Both are used until the end.
  LiveRun(const RunOptions& options, const scenario::LoadedScenario& loaded);

  /// Starts one process for each service of the scenario.
  void start_services();

  /// Sends the scheduled swaps while the run goes on; returns when every process has ended or something went wrong.
  /// `meanwhile` is called every few milliseconds.
  void follow(const std::function<void()>& meanwhile = [] {});

  /// What went wrong; nothing when nothing did.
  std::optional<std::string> failure() const;

  RunClient& client() { return client_; }
  const ChildProcesses& services() const { return children_; }

 private:
  std::string words_of_rest() const;
  void tell_wait(const Progress& progress, const std::string& message);
  void note_early_ends(const Progress& progress);
  void note_fault(const ServiceStatus& status);
  std::string reason() const;
  void restart_killed(const Progress& progress);
  void send_due_swaps(const SimStatus& status);

  const RunOptions& options_;
  const scenario::LoadedScenario& loaded_;
  app::Identity identity_;
  dds::Participant participant_;
  RunClient client_;
  mutable std::mutex mutex_;
  std::string first_fault_;  ///< of a service
  dds::Reader<ServiceStatus> faults_;
  std::vector<std::string> early_ends_;  ///< which service left the run, and when
  std::string told_wait_;
  ChildProcesses children_;
  bool lockstep_;
  bool holds_the_start_;  ///< until every scheduled swap is in the journal
  bool released_ = false;
  std::size_t next_swap_ = 0;
  std::optional<time::Nanoseconds> stop_deadline_;
  std::optional<time::Nanoseconds> run_ended_;
};

}  // namespace inslab::cli
