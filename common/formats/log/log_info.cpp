#include "inslab/formats/log/log_info.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "inslab/formats/log/log_types.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"

namespace inslab::log {
namespace {

/// One topic while the log is read.
class TopicScan {
 public:
  TopicScan(const mcap::Channel& channel, std::string type_name) : type_(find_log_type(type_name)) {
    info_.topic = channel.topic;
    info_.type = std::move(type_name);
  }

  /// The stamp of the sample; null when there is none.
  const SampleStamp* add(const mcap::Message& message) {
    ++info_.count;
    if (type_ == nullptr) return nullptr;
    if (!type_->stamp(message.data, message.size, stamp_)) {
      ++info_.unreadable;
      return nullptr;
    }
    if (stamp_.sim_time_ns) {
      info_.first_sim_time_ns = std::min(info_.first_sim_time_ns.value_or(*stamp_.sim_time_ns), *stamp_.sim_time_ns);
      info_.last_sim_time_ns = std::max(info_.last_sim_time_ns.value_or(*stamp_.sim_time_ns), *stamp_.sim_time_ns);
      ++timed_;
    }
    if (stamp_.sequence_number) {
      info_.is_numbered = true;
      if (run_id_ != stamp_.run_id) end_run();
      run_id_ = stamp_.run_id;
      check_.add(*stamp_.sequence_number, stamp_.sim_time_ns.value_or(0));
    }
    return &stamp_;
  }

  TopicInfo finish() {
    end_run();
    if (timed_ > 1 && *info_.last_sim_time_ns > *info_.first_sim_time_ns) {
      // Through double: the difference of two wild times would overflow.
      const double span_s =
          (static_cast<double>(*info_.last_sim_time_ns) - static_cast<double>(*info_.first_sim_time_ns)) * 1e-9;
      info_.rate_hz = static_cast<double>(timed_ - 1) / span_s;
    }
    return info_;
  }

 private:
  void end_run() {
    const std::vector<SequenceGap> gaps = check_.gaps();
    info_.gaps.insert(info_.gaps.end(), gaps.begin(), gaps.end());
    info_.missing += check_.missing();
    info_.duplicates += check_.duplicates();
    info_.out_of_order += check_.out_of_order();
    check_ = {};
  }

  const LogType* type_;
  TopicInfo info_;
  SampleStamp stamp_;
  SequenceCheck check_;
  std::optional<RunId> run_id_;
  std::uint64_t timed_ = 0;
};

}  // namespace

LogInfo inspect_log(const std::string& path) {
  const mcap::McapReader reader(path);
  LogInfo info;
  info.path = path;
  info.file_size = reader.file_size();
  info.library = reader.library();
  info.closed_properly = reader.closed_properly();
  info.ending = reader.ending();
  info.message_count = reader.statistics().message_count;
  info.chunk_count = reader.statistics().chunk_count;
  info.metadata = reader.metadata();

  std::map<std::uint16_t, TopicScan> topics;
  for (const auto& [id, channel] : reader.channels()) {
    const auto schema = reader.schemas().find(channel.schema_id);
    topics.emplace(id, TopicScan(channel, schema == reader.schemas().end() ? "" : schema->second.name));
  }
  std::optional<RunId> newest_run;
  std::set<std::string> known_runs;
  reader.for_each([&](const mcap::Message& message) {
    const SampleStamp* stamp = topics.at(message.channel_id).add(message);
    // A service that waits for its run has no id yet.
    if (stamp != nullptr && stamp->run_id && *stamp->run_id != RunId() && stamp->run_id != newest_run) {
      newest_run = stamp->run_id;
      const std::string name = tables::to_hex(*newest_run);
      if (known_runs.insert(name).second) info.run_ids.push_back(name);
    }
    return true;
  });
  for (auto& [id, topic] : topics) info.topics.push_back(topic.finish());
  std::sort(info.topics.begin(), info.topics.end(), [](const auto& a, const auto& b) { return a.topic < b.topic; });
  return info;
}

}  // namespace inslab::log
