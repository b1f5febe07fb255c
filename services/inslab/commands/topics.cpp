#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/client/topic_tap.hpp"
#include "inslab/bus/dds/discovery.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/latency_histogram.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {

namespace {

struct TopicsOptions {
  std::string topic;
  double seconds = 5.0;
  std::uint64_t count = 0;
  app::NetworkOptions network;
};

struct Counted {
  std::string type;
  int writers = 0;
  int readers = 0;
};

int list(const TopicsOptions& options) {
  if (options.seconds > 2.0) fmt::print(stderr, "listens for {:g} s on {}\n", options.seconds, options.network.words());
  const dds::Discovery discovery(app::participant_options(options.network, "inslab-topics"));
  listen_for(options.seconds);
  std::map<std::string, Counted> topics;
  for (const dds::Endpoint& endpoint : discovery.endpoints()) {
    Counted& counted = topics[endpoint.topic];
    counted.type = endpoint.type;
    ++(endpoint.is_writer ? counted.writers : counted.readers);
  }
  fmt::print("{:<36}{:<30}{:>8}{:>8}\n", "topic", "type", "writers", "readers");
  for (const auto& [name, counted] : topics) {
    fmt::print("{:<36}{:<30}{:>8}{:>8}\n", name, counted.type, counted.writers, counted.readers);
  }
  if (topics.empty()) {
    fmt::print(stderr, "nobody was heard in {:g} s on {}: is the set running there?\n", options.seconds,
               options.network.words());
    return app::kFailed;
  }
  return app::kOk;
}

/// What a tapped topic brought, decoded in the worker.
struct Message {
  const io::LogType* type;
  std::vector<std::uint8_t> cdr;
  std::int64_t received_realtime_ns;
};

std::string why_nothing(const TopicTap& tap, const TopicsOptions& options) {
  return tap.matched_writers() == 0 ? "it has no writer on " + options.network.words() + ": is the set running there?"
                                    : "its writer is there and sends none";
}

/// Hands every message of the topic to `each` until the time is over, `count` have come, or a signal; the number of
/// messages.
std::uint64_t listen(const TopicsOptions& options, const std::function<void(const Message&)>& each) {
  const app::OwnEnding leaves_the_domain(app::OwnEnding::Then::CodeStands);
  app::Mailbox<Message> mailbox;
  dds::ParticipantOptions onlooker = app::participant_options(options.network, "inslab-topics");
  onlooker.looks_on = true;
  dds::Participant participant(onlooker);
  const TopicTap tap(participant, options.topic, [&mailbox](const TappedMessage& message) {
    mailbox.put({&message.type, message.cdr, message.received_realtime_ns});
  });
  const time::Nanoseconds begun = app::monotonic_now();
  const time::Nanoseconds end = begun + time::from_seconds(options.seconds);
  LongWait wait;
  std::uint64_t messages = 0;
  while (app::monotonic_now() < end && !app::shutdown_requested() && (options.count == 0 || messages < options.count)) {
    const auto message = mailbox.take(std::chrono::milliseconds(50));
    if (!message && messages == 0) wait.tell("a message of " + options.topic + "; " + why_nothing(tap, options));
    if (!message) continue;
    ++messages;
    each(*message);
  }
  if (messages == 0) {
    fmt::print(stderr, "nothing came on {} in {:.1f} s; {}\n", options.topic,
               time::to_seconds(app::monotonic_now() - begun), why_nothing(tap, options));
  }
  return messages;
}

int echo(const TopicsOptions& options) {
  io::Row row;
  const auto messages = listen(options, [&row](const Message& message) {
    if (!message.type->row(message.cdr.data(), message.cdr.size(), row)) return;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (std::holds_alternative<std::monostate>(row[i])) continue;
      fmt::print("{}: {}\n", message.type->columns[i].name, io::csv_text(row[i]));
    }
    fmt::print("---\n");
  });
  return messages > 0 ? app::kOk : app::kFailed;
}

int rate(const TopicsOptions& options) {
  std::vector<double> gaps_s;
  std::int64_t last_ns = 0;
  listen(options, [&](const Message& message) {
    if (last_ns != 0) gaps_s.push_back(static_cast<double>(message.received_realtime_ns - last_ns) * 1e-9);
    last_ns = message.received_realtime_ns;
  });
  if (gaps_s.empty()) return app::kFailed;
  double sum = 0.0;
  double squares = 0.0;
  for (const double gap : gaps_s) sum += gap;
  const double mean = sum / static_cast<double>(gaps_s.size());
  for (const double gap : gaps_s) squares += (gap - mean) * (gap - mean);
  const auto [least, most] = std::minmax_element(gaps_s.begin(), gaps_s.end());
  fmt::print("{}: {:.3f} Hz over {} intervals; interval min {:.6f} s, max {:.6f} s, standard deviation {:.6f} s\n",
             options.topic, 1.0 / mean, gaps_s.size(), *least, *most,
             std::sqrt(squares / static_cast<double>(gaps_s.size())));
  return app::kOk;
}

int delay(const TopicsOptions& options) {
  app::LatencyHistogram delays;
  bool stamped = false;
  io::Row row;
  listen(options, [&](const Message& message) {
    const auto& columns = message.type->columns;
    const auto column = std::find_if(columns.begin(), columns.end(), [](const io::Column& c) {
      return c.name == "header.publish_realtime_ns" || c.name == "realtime_ns";
    });
    if (column == columns.end() || !message.type->row(message.cdr.data(), message.cdr.size(), row)) return;
    stamped = true;
    const auto sent_ns = std::get<std::int64_t>(row[static_cast<std::size_t>(column - columns.begin())]);
    delays.add(static_cast<double>(message.received_realtime_ns - sent_ns) * 1e-9);
  });
  if (!stamped) {
    fmt::print(stderr, "{}: no message with a publish time\n", options.topic);
    return app::kFailed;
  }
  fmt::print(
      "{}: publish to receipt p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms (of two hosts: as good as their clocks "
      "agree)\n",
      options.topic, delays.quantile_s(0.5) * 1e3, delays.quantile_s(0.99) * 1e3, delays.max_s() * 1e3);
  return app::kOk;
}

}  // namespace

void add_topics(CLI::App& app, std::function<int()>& action) {
  CLI::App* topics = app.add_subcommand("topics", "Look at what is on the bus");
  topics->require_subcommand(1);
  const auto add = [&](const char* name, const char* purpose, int (*work)(const TopicsOptions&), bool of_one_topic,
                       double seconds) {
    auto options = std::make_shared<TopicsOptions>();
    options->seconds = seconds;
    CLI::App* command = topics->add_subcommand(name, purpose);
    if (of_one_topic) command->add_option("topic", options->topic, "such as inslab/imu/0")->required();
    command->add_option("--seconds", options->seconds, "how long to listen")
        ->check(CLI::Range(0.1, 1e6))
        ->capture_default_str();
    if (of_one_topic) command->add_option("--count", options->count, "stop after so many messages");
    options->network.add_to(*command);
    command->callback([&action, options, work] { action = [options, work] { return work(*options); }; });
  };
  add("ls", "List the topics with their types, writers and readers", list, false, 2.5);
  add("echo", "Print the messages of a topic", echo, true, 1e6);
  add("hz", "Measure the rate of a topic", rate, true, 5.0);
  add("delay", "Measure the time from publishing to receipt", delay, true, 5.0);
}

}  // namespace inslab::cli
