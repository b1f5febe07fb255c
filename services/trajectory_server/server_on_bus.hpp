#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/bus/service/status_board.hpp"
#include "inslab/bus/service/stream_output.hpp"
#include "inslab/data/streams/run_follower.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/services/trajectory_server/vehicle_on_bus.hpp"
#include "inslab/sim/other_runs.hpp"
#include "inslab/sim/run_clock.hpp"
#include "inslab/sim/run_gate.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::trajectory_server {

/// The trajectory server on the bus: waits until every service that the scenario needs is ready, then sends the truth,
/// on a grid of absolute deadlines or as fast as its consumers give credit, journals the requests for swaps, obeys the
/// commands, and says how the run goes. The only clock of the run.
///
/// A run has one trajectory server from its start to its end. One that finds services still in a run whose server is
/// gone (killed, and started again) ends that run as a fault, so that every log is closed, and then itself: a run is
/// never gone on with by another clock, nor run twice. One that finds a service with another scenario than its own does
/// not begin.
class ServerOnBus {
 public:
  explicit ServerOnBus(service::Context& context);

  /// Returns the exit code.
  int run();

 private:
  using Message = std::variant<catalog::AnyProfile, SimCommand, ServiceStatus, Credit, VehicleState>;
  struct Heard {
    ServiceState state;
    std::string message;
    bool is_fault_of_this_run;
  };

  template <class Profile>
  void open_profile_topics(dds::Participant& participant);
  void handle_messages(time::Nanoseconds patience);
  void judge(const catalog::AnyProfile& request);
  void obey(const SimCommand& command);
  std::string missing_services() const;
  std::string missing_apps() const;
  void tell_wait(const std::string& names);
  std::string missing_peers() const;
  bool wait_until_ready();
  std::string stranger_among_services();
  void warn_of_other_versions();
  std::optional<int> end_run_without_server();
  int end_run_of(const ServiceStatus& orphan);
  void begin();
  int run_to_end();
  void serve_stragglers(time::Nanoseconds patience);
  void tell_the_wait_for_the_log();
  void stay_for_the_log();
  void wait_paused();
  void send_at_deadline();
  void send_in_lockstep();
  void send(TruthState& sample);
  bool ends_block(const TruthState& sample) const;
  void watch_consumers();
  bool clock_stands() const;
  std::string fault_of_a_service() const;
  void send_time_mark();
  void report_status();
  /// Puts a message into the status, of which nothing is sent yet.
  void say(const std::string& message) { status_.message = text::cut(text::shown(message), 256); }
  int end(RunState state, const std::string& message);

  service::Context& context_;
  const scenario::LoadedScenario& scenario_;
  double shortest_period_s_;
  RunId run_id_;
  sim::OtherRuns others_;
  streams::RunFollower run_;  ///< its own run, from the end on
  std::unique_ptr<sim::TruthSource> source_;
  SimStatus status_;
  sim::RunControl control_;
  sim::RunClock clock_;
  time::Nanoseconds next_report_{0};    ///< CLOCK_MONOTONIC
  time::Nanoseconds blocked_since_{0};  ///< CLOCK_MONOTONIC since no consumer gave credit; 0: not blocked
  std::uint64_t time_marks_ = 0;
  std::set<dds::ParticipantKey> told_of_version_;
  std::optional<time::Nanoseconds> stranger_since_;  ///< CLOCK_MONOTONIC; nothing: there is none
  std::map<std::pair<std::string, std::uint32_t>, Heard> services_;
  bool fault_heard_ = false;  ///< of a service, in this run
  host::Mailbox<Message> mailbox_;
  std::unique_ptr<VehicleOnBus> vehicle_;  ///< null when the scenario has no live vehicle
  service::StreamOutput<TruthState> truth_;
  service::StatusBoard board_;
  dds::Writer<SimStatus> sim_status_;
  dds::Writer<Installation> installation_;
  dds::Writer<TimeMark> time_mark_;
  dds::Writer<ProfileAck> acks_;
  std::vector<std::shared_ptr<void>> entities_;  ///< request readers and journal writers of every kind
  std::map<ProfileKind, std::function<void(const catalog::AnyProfile&)>> write_journal_;
  dds::OpenReader<SimCommand> commands_;
  service::SetReader<ServiceStatus> service_status_;
  service::SetReader<Credit> credits_;
};

}  // namespace inslab::trajectory_server
