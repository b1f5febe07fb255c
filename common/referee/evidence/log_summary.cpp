#include "inslab/referee/evidence/log_summary.hpp"

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/sim/run_log.hpp"

namespace inslab::evidence {

namespace {

/// What a metadata record holds as JSON. Throws json::Error.
json::Json json_of(const mcap::Metadata& record, const std::string& place) {
  const auto json = record.values.find("json");
  if (json == record.values.end()) throw json::Error(place, {Rule::RequiredKey, "json", "missing"});
  return json::parse_json(json->second, place);
}

template <class Profile>
void read_initial(const mcap::McapReader& log, const SensorAddress& sensor, LogSummary& summary) {
  const std::string name = sim::profile_record(Profile::kind, sensor, 0);
  for (const auto& record : log.metadata()) {
    if (record.name != name) continue;
    const std::string place = log.path() + " (metadata " + name + ")";
    auto profile = json::struct_from_json<Profile>(json_of(record, place), place);
    profile.target = sensor;
    summary.profiles.push_back({-1, profile});
  }
}

std::string value_of(const mcap::StringMap& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : text::shown(found->second);
}

void read_metadata(const mcap::McapReader& log, LogSummary& summary) {
  for (const auto& record : log.metadata()) {
    if (record.name.rfind("recovery/", 0) == 0) summary.recoveries.push_back(record.values);
    if (record.name == "build") summary.identity.version = value_of(record.values, "version");
    if (record.name != "scenario") continue;
    summary.identity.scenario_file = value_of(record.values, "file");
    summary.identity.unit = value_of(record.values, "unit");
    const std::string place = log.path() + " (metadata scenario)";
    summary.scenario = json::struct_from_json<scenario::Scenario>(json_of(record, place), place);
  }
  for_each_sensor(summary.scenario, [&](auto tag, const auto& sensor) {
    using Kind = typename decltype(tag)::type;
    for_each(typename Kind::Profiles{}, [&](auto profile) {
      read_initial<typename decltype(profile)::type>(log, {Kind::kind, sensor.number}, summary);
    });
  });
}

}  // namespace

ProfileTimeline::ProfileTimeline(const std::vector<ProfileInUse>& profiles) {
  for (std::size_t place = 0; place < profiles.size(); ++place) {
    const SensorAddress sensor = catalog::target_of(profiles[place].profile);
    entries_[{catalog::kind_of(profiles[place].profile), sensor.kind, sensor.number}].push_back(
        {profiles[place].apply_at_ns, place});
  }
  for (auto& [key, entries] : entries_) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.apply_at_ns < b.apply_at_ns; });
  }
}

std::optional<std::size_t> ProfileTimeline::at(ProfileKind kind, const SensorAddress& sensor,
                                               std::int64_t sim_time_ns) const {
  const auto found = entries_.find({kind, sensor.kind, sensor.number});
  if (found == entries_.end()) return std::nullopt;
  const auto later = std::lower_bound(found->second.begin(), found->second.end(), sim_time_ns,
                                      [](const Entry& entry, std::int64_t t) { return entry.apply_at_ns < t; });
  return later == found->second.begin() ? std::nullopt : std::optional(std::prev(later)->place);
}

const catalog::AnyProfile* LogSummary::in_use(ProfileKind kind, const SensorAddress& sensor,
                                              std::int64_t sim_time_ns) const {
  const std::optional<std::size_t> place = timeline.at(kind, sensor, sim_time_ns);
  return place ? &profiles[*place].profile : nullptr;
}

SummaryOfLog::SummaryOfLog(const mcap::McapReader& log) {
  summary_.path = log.path();
  summary_.closed_properly = log.closed_properly();
  summary_.ending = log.ending();
  read_metadata(log, summary_);
}

void SummaryOfLog::take_part(log::LogWalk& walk) {
  walk.each<TruthState>([this](const TruthState& truth) { identify(truth); });
  stream<TruthState>(walk);
  for_each(catalog::SensorSamples{}, [&](auto sample) { stream<typename decltype(sample)::type>(walk); });
  stream<UsedVehicleState>(walk);
  walk.each_message(catalog::kNav.name, [this] { ++summary_.nav_solutions; });
  walk.each<ProfileAck>([this](const ProfileAck& ack) { summary_.acks.push_back(ack); });
  walk.each<SimStatus>([this](const SimStatus& status) { summary_.last_status = status; });
  walk.each<VehicleLink>([this](const VehicleLink& link) { summary_.vehicle_link = link; });
  walk.each<ServiceStatus>([this](const ServiceStatus& status) {
    services_[{status.service, status.sensor_number}] = status;
  });
  for_each(catalog::ProfileKinds{}, [&](auto profile) { journal<typename decltype(profile)::type>(walk); });
}

/// From the first sample of the truth.
void SummaryOfLog::identify(const TruthState& truth) {
  RunIdentity& identity = summary_.identity;
  if (!identity.run_id.empty()) return;
  identity.run_id = host::run_id_text(truth.header.run_id);
  const std::int64_t sent_ns = truth.header.publish_realtime_ns;
  if (sent_ns > 0) identity.began_utc = host::utc_words(time::Nanoseconds(sent_ns));
}

template <class T>
void SummaryOfLog::stream(log::LogWalk& walk) {
  walk.each<T>([this](const T& sample, const log::LogWalk::Place& place) {
    auto found = monitors_.find(place.topic);
    if (found == monitors_.end()) {
      found = monitors_.emplace(place.topic, streams::StreamMonitor(place.topic, StreamDirection::In)).first;
    }
    found->second.received(sample.header, place.log_time_ns);
  });
}

template <class Profile>
void SummaryOfLog::journal(log::LogWalk& walk) {
  walk.each<Profile>([this](const Profile& entry, const log::LogWalk::Place& place) {
    if (place.topic.rfind(catalog::kJournal, 0) == 0) {
      summary_.profiles.push_back({entry.request.apply_at_ns, entry});
    }
  });
}

LogSummary SummaryOfLog::finish() {
  for (auto& [topic, monitor] : monitors_) summary_.streams[topic].logged = monitor.status();
  for (const auto& [key, status] : services_) {
    summary_.services.push_back(status);
    if (status.state != ServiceState::Finished && status.state != ServiceState::Fault) continue;
    for (const StreamStatus& stream : status.streams) {
      if (stream.direction != StreamDirection::Out) continue;
      summary_.streams[stream.topic].sent = stream.samples;
      if (stream.topic == catalog::kNav.name) {
        summary_.streams[stream.topic].logged.samples = summary_.nav_solutions;
      }
    }
  }
  // Requests of one journal come over a topic for each kind of profile, which keep no order among each other.
  std::stable_sort(
      summary_.profiles.begin(), summary_.profiles.end(), [](const ProfileInUse& a, const ProfileInUse& b) {
        return catalog::request_of(a.profile).journal_number < catalog::request_of(b.profile).journal_number;
      });
  summary_.timeline = ProfileTimeline(summary_.profiles);
  return std::move(summary_);
}

LogSummary summarize(const mcap::McapReader& log) {
  SummaryOfLog summary(log);
  log::LogWalk walk(log);
  summary.take_part(walk);
  walk.go();
  return summary.finish();
}

}  // namespace inslab::evidence
