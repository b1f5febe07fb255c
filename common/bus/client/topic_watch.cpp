#include "inslab/bus/client/topic_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/client/topic_tap.hpp"
#include "inslab/bus/dds/discovery.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::client {

namespace {

std::string why_nothing(const TopicTap& tap, const WatchOptions& options) {
  return tap.matched_writers() == 0 ? "it has no writer on " + options.network.words() + ": is the set running there?"
                                    : "its writer is there and sends none";
}

}  // namespace

std::map<std::string, TopicOnBus> topics_on_bus(const service::NetworkOptions& network, double seconds) {
  const dds::Discovery discovery(service::participant_options(network, "inslab-topics"));
  listen_for(seconds);
  std::map<std::string, TopicOnBus> topics;
  for (const dds::Endpoint& endpoint : discovery.endpoints()) {
    TopicOnBus& topic = topics[endpoint.topic];
    topic.type = endpoint.type;
    ++(endpoint.is_writer ? topic.writers : topic.readers);
  }
  return topics;
}

std::string WatchedMessage::text() const {
  tables::Row row;
  std::string lines;
  if (!type.row(cdr.data(), cdr.size(), row)) return lines;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (std::holds_alternative<std::monostate>(row[i])) continue;
    lines += fmt::format("{}: {}\n", type.columns[i].name, tables::csv_text(row[i]));
  }
  return lines;
}

std::optional<double> WatchedMessage::delay_s() const {
  const auto column = std::find_if(type.columns.begin(), type.columns.end(), [](const tables::Column& c) {
    return c.name == "header.publish_realtime_ns" || c.name == "realtime_ns";
  });
  tables::Row row;
  if (column == type.columns.end() || !type.row(cdr.data(), cdr.size(), row)) return std::nullopt;
  const auto sent_ns = std::get<std::int64_t>(row[static_cast<std::size_t>(column - type.columns.begin())]);
  return time::to_seconds(received_realtime_ns - sent_ns);
}

Watched watch_topic(const WatchOptions& options, const std::function<void(const WatchedMessage&)>& each) {
  host::Mailbox<WatchedMessage> mailbox;
  dds::ParticipantOptions onlooker = service::participant_options(options.network, "inslab-topics");
  onlooker.looks_on = true;
  dds::Participant participant(onlooker);
  const TopicTap tap(participant, options.topic, [&mailbox](const TappedMessage& message) {
    mailbox.put({message.type, message.cdr, message.received_realtime_ns});
  });
  const time::Nanoseconds begun = host::monotonic_now();
  const time::Nanoseconds end = begun + time::from_seconds(options.seconds);
  LongWait wait;
  Watched watched;
  while (host::monotonic_now() < end && !host::shutdown_requested() &&
         (options.count == 0 || watched.messages < options.count)) {
    const auto message = mailbox.take(std::chrono::milliseconds(50));
    if (!message && watched.messages == 0) {
      wait.tell("a message of " + options.topic + "; " + why_nothing(tap, options));
    }
    if (!message) continue;
    ++watched.messages;
    each(*message);
  }
  if (watched.messages == 0) {
    watched.why_nothing = fmt::format("nothing came on {} in {:.1f} s; {}", options.topic,
                                      time::to_seconds(host::monotonic_now() - begun), why_nothing(tap, options));
  }
  return watched;
}

void Intervals::add(std::int64_t received_realtime_ns) {
  if (last_ns_) intervals_s_.push_back(time::to_seconds(received_realtime_ns - *last_ns_));
  last_ns_ = received_realtime_ns;
}

std::optional<Intervals::Figures> Intervals::figures() const {
  if (intervals_s_.empty()) return std::nullopt;
  Figures figures;
  figures.count = intervals_s_.size();
  const auto count = static_cast<double>(intervals_s_.size());
  for (const double interval_s : intervals_s_) figures.mean_s += interval_s / count;
  double squares = 0.0;
  for (const double interval_s : intervals_s_) squares += (interval_s - figures.mean_s) * (interval_s - figures.mean_s);
  figures.deviation_s = std::sqrt(squares / count);
  const auto [least, most] = std::minmax_element(intervals_s_.begin(), intervals_s_.end());
  figures.least_s = *least;
  figures.most_s = *most;
  return figures;
}

}  // namespace inslab::client
