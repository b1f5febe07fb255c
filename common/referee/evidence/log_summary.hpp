#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/vehicle_state.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/formats/log/log_walk.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::evidence {

/// One stream as its writer and as the log saw it.
struct StreamSummary {
  std::optional<std::uint64_t> sent;  ///< as the service said when it finished; nothing when it did not
  StreamStatus logged;
};

/// A profile and from when on a sensor used it.
struct ProfileInUse {
  std::int64_t apply_at_ns = -1;  ///< negative: from the start
  catalog::AnyProfile profile;
};

/// Which of a run's profiles a sensor used when, found in the logarithm of their number.
class ProfileTimeline {
 public:
  ProfileTimeline() = default;
  explicit ProfileTimeline(const std::vector<ProfileInUse>& profiles);

  /// Place among the profiles of the one in use for a sample of sim time `t`; nothing when there is none. Of two that
  /// take effect at one time it is the later in their order.
  std::optional<std::size_t> at(ProfileKind kind, const SensorAddress& sensor, std::int64_t sim_time_ns) const;

 private:
  using Key = std::tuple<ProfileKind, SensorKind, std::uint32_t>;
  struct Entry {
    std::int64_t apply_at_ns;
    std::size_t place;
  };
  std::map<Key, std::vector<Entry>> entries_;  ///< in order of their apply times
};

/// Which run a log is of. Texts are empty where the log does not say.
struct RunIdentity {
  std::string run_id;     ///< hexadecimal
  std::string began_utc;  ///< when its first truth sample was sent, "2026-11-29 04:20:11 UTC"; empty: not live
  std::string scenario_file;
  std::string unit;
  std::string version;  ///< of the program that wrote the log
};

/// What a log says about the run as a whole.
struct LogSummary {
  std::string path;
  bool closed_properly = false;
  std::string ending;  ///< of one that was not closed, in words
  RunIdentity identity;
  scenario::Scenario scenario;
  std::optional<SimStatus> last_status;
  std::map<std::string, StreamSummary> streams;  ///< by topic
  std::uint64_t nav_solutions = 0;               ///< of the app under test
  std::vector<ServiceStatus> services;           ///< the last report of each
  std::optional<VehicleLink> vehicle_link;       ///< the last report; of a live vehicle only
  std::vector<ProfileAck> acks;
  std::vector<mcap::StringMap> recoveries;  ///< see sim::RunLog
  std::vector<ProfileInUse> profiles;       ///< what the scenario began with, and the journal in its order
  ProfileTimeline timeline;                 ///< of these profiles

  /// The profile of that kind and sensor in use for a sample of sim time `t`; null when there is none.
  const catalog::AnyProfile* in_use(ProfileKind kind, const SensorAddress& sensor, std::int64_t sim_time_ns) const;
};

/// Gathers the summary of a log along a walk.
class SummaryOfLog {
 public:
  /// What the log says of scenario and profiles is there at once. Throws json::Error when that is no JSON of ours.
  explicit SummaryOfLog(const mcap::McapReader& log);

  const scenario::Scenario& scenario() const { return summary_.scenario; }

  /// Asks for what it wants to know. It stays where it is until the walk is over.
  void take_part(log::LogWalk& walk);

  /// When the walk is over; once.
  LogSummary finish();

 private:
  void identify(const TruthState& truth);
  template <class T>
  void stream(log::LogWalk& walk);
  template <class Profile>
  void journal(log::LogWalk& walk);

  LogSummary summary_;
  std::map<std::string, streams::StreamMonitor> monitors_;
  std::map<std::pair<std::string, std::uint32_t>, ServiceStatus> services_;
};

/// Reads a whole log once, for its summary alone. Throws files::ReadError, and as SummaryOfLog does.
LogSummary summarize(const mcap::McapReader& log);

}  // namespace inslab::evidence
