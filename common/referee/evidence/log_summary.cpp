#include "inslab/referee/evidence/log_summary.hpp"

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/sim/run_log.hpp"

namespace inslab::cli {

namespace {

template <class T>
std::optional<T> decoded(const io::mcap::Message& message) {
  T value;
  if (!wire::decode(message.data, message.size, value)) return std::nullopt;
  return value;
}

/// What is being gathered while the log is read.
class Gatherer {
 public:
  explicit Gatherer(LogSummary& summary) : summary_(summary) {}

  void take(const std::string& topic, const std::string& type, const io::mcap::Message& message) {
    if (type == wire::WireType<TruthState>::name) {
      identify(message);
      return stream<TruthState>(topic, message);
    }
    if (sensor_stream(topic, type, message)) return;
    if (type == wire::WireType<UsedVehicleState>::name) return stream<UsedVehicleState>(topic, message);
    if (topic == catalog::kNav.name) {
      ++summary_.nav_solutions;
    } else if (type == wire::WireType<ProfileAck>::name) {
      if (auto ack = decoded<ProfileAck>(message)) summary_.acks.push_back(*ack);
    } else if (type == wire::WireType<SimStatus>::name) {
      if (auto status = decoded<SimStatus>(message)) summary_.last_status = *status;
    } else if (type == wire::WireType<VehicleLink>::name) {
      if (auto link = decoded<VehicleLink>(message)) summary_.vehicle_link = *link;
    } else if (type == wire::WireType<ServiceStatus>::name) {
      if (auto status = decoded<ServiceStatus>(message)) services_[{status->service, status->sensor_number}] = *status;
    } else if (topic.rfind(catalog::kJournal, 0) == 0) {
      journal(type, message);
    }
  }

  void finish() {
    for (auto& [topic, monitor] : monitors_) summary_.streams[topic].logged = monitor.status();
    for (const auto& [key, status] : services_) {
      summary_.services.push_back(status);
      if (status.state != ServiceState::Finished && status.state != ServiceState::Fault) continue;
      for (const StreamStatus& stream : status.streams) {
        if (stream.direction != StreamDirection::Out) continue;
        summary_.streams[stream.topic].sent = stream.samples;
        if (stream.topic == catalog::kNav.name) summary_.streams[stream.topic].logged.samples = summary_.nav_solutions;
      }
    }
  }

 private:
  /// From the first sample of the truth.
  void identify(const io::mcap::Message& message) {
    RunIdentity& identity = summary_.identity;
    if (!identity.run_id.empty()) return;
    const auto truth = decoded<TruthState>(message);
    if (!truth) return;
    identity.run_id = app::run_id_text(truth->header.run_id);
    const std::int64_t sent_ns = truth->header.publish_realtime_ns;
    if (sent_ns > 0) identity.began_utc = app::utc_words(time::Nanoseconds(sent_ns));
  }

  /// False when it is none.
  bool sensor_stream(const std::string& topic, const std::string& type, const io::mcap::Message& message) {
    bool is_one = false;
    for_each(catalog::SensorSamples{}, [&](auto sample) {
      using Sample = typename decltype(sample)::type;
      if (type != wire::WireType<Sample>::name) return;
      is_one = true;
      stream<Sample>(topic, message);
    });
    return is_one;
  }

  template <class T>
  void stream(const std::string& topic, const io::mcap::Message& message) {
    const auto sample = decoded<T>(message);
    if (!sample) return;
    auto found = monitors_.find(topic);
    if (found == monitors_.end()) {
      found = monitors_.emplace(topic, app::StreamMonitor(topic, StreamDirection::In)).first;
    }
    found->second.received(sample->header, static_cast<std::int64_t>(message.log_time_ns));
  }

  void journal(const std::string& type, const io::mcap::Message& message) {
    for_each(catalog::ProfileKinds{},
             [&](auto profile) { journal_entry<typename decltype(profile)::type>(type, message); });
  }
  template <class Profile>
  void journal_entry(const std::string& type, const io::mcap::Message& message) {
    if (type != wire::WireType<Profile>::name) return;
    if (auto entry = decoded<Profile>(message)) summary_.profiles.push_back({entry->request.apply_at_ns, *entry});
  }

  LogSummary& summary_;
  std::map<std::string, app::StreamMonitor> monitors_;
  std::map<std::pair<std::string, std::uint32_t>, ServiceStatus> services_;
};

/// What a metadata record holds as JSON. Throws config::Error.
config::Json json_of(const io::mcap::Metadata& record, const std::string& place) {
  const auto json = record.values.find("json");
  if (json == record.values.end()) throw config::Error(place, {Rule::RequiredKey, "json", "missing"});
  return config::parse_json(json->second, place);
}

template <class Profile>
void read_initial(const io::McapReader& log, const SensorAddress& sensor, LogSummary& summary) {
  const std::string name = logger::profile_record(Profile::kind, sensor, 0);
  for (const auto& record : log.metadata()) {
    if (record.name != name) continue;
    const std::string place = log.path() + " (metadata " + name + ")";
    auto profile = config::from_json<Profile>(json_of(record, place), place);
    profile.target = sensor;
    summary.profiles.push_back({-1, profile});
  }
}

std::string value_of(const io::mcap::StringMap& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : text::shown(found->second);
}

void read_metadata(const io::McapReader& log, LogSummary& summary) {
  for (const auto& record : log.metadata()) {
    if (record.name.rfind("recovery/", 0) == 0) summary.recoveries.push_back(record.values);
    if (record.name == "build") summary.identity.version = value_of(record.values, "version");
    if (record.name != "scenario") continue;
    summary.identity.scenario_file = value_of(record.values, "file");
    summary.identity.unit = value_of(record.values, "unit");
    const std::string place = log.path() + " (metadata scenario)";
    summary.scenario = config::from_json<scenario::Scenario>(json_of(record, place), place);
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
    const SensorAddress sensor = target_of(profiles[place].profile);
    entries_[{kind_of(profiles[place].profile), sensor.kind, sensor.number}].push_back(
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

const AnyProfile* LogSummary::in_use(ProfileKind kind, const SensorAddress& sensor, std::int64_t sim_time_ns) const {
  const std::optional<std::size_t> place = timeline.at(kind, sensor, sim_time_ns);
  return place ? &profiles[*place].profile : nullptr;
}

LogSummary summarize(const io::McapReader& log) {
  LogSummary summary;
  read_metadata(log, summary);
  Gatherer gatherer(summary);
  const auto types = io::channel_types(log);
  log.for_each([&](const io::mcap::Message& message) {
    const auto& channel = log.channels().at(message.channel_id);
    gatherer.take(channel.topic, types.at(message.channel_id), message);
    return true;
  });
  gatherer.finish();
  // Requests of one journal come over a topic for each kind of profile, which keep no order among each other.
  std::stable_sort(summary.profiles.begin(), summary.profiles.end(), [](const ProfileInUse& a, const ProfileInUse& b) {
    return request_of(a.profile).journal_number < request_of(b.profile).journal_number;
  });
  summary.timeline = ProfileTimeline(summary.profiles);
  return summary;
}

}  // namespace inslab::cli
