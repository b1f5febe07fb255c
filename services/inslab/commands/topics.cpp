#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/bus/client/topic_watch.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/latency_histogram.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

int list(const client::WatchOptions& options) {
  if (options.seconds > 2.0)
    terminal::tell(stderr, "listens for {:g} s on {}\n", options.seconds, options.network.words());
  const auto topics = client::topics_on_bus(options.network, options.seconds);
  terminal::tell("{:<36}{:<30}{:>8}{:>8}\n", "topic", "type", "writers", "readers");
  for (const auto& [name, topic] : topics) {
    terminal::tell("{:<36}{:<30}{:>8}{:>8}\n", name, topic.type, topic.writers, topic.readers);
  }
  if (!topics.empty()) return host::kOk;
  terminal::tell(stderr, "nobody was heard in {:g} s on {}: is the set running there?\n", options.seconds,
                 options.network.words());
  return host::kFailed;
}

std::uint64_t watch(const client::WatchOptions& options,
                    const std::function<void(const client::WatchedMessage&)>& each) {
  const host::OwnEnding leaves_the_domain(host::OwnEnding::Then::CodeStands);
  const client::Watched watched = client::watch_topic(options, each);
  if (watched.messages == 0) terminal::tell(stderr, "{}\n", watched.why_nothing);
  return watched.messages;
}

int echo(const client::WatchOptions& options) {
  const auto messages = watch(options, [](const client::WatchedMessage& message) {
    if (const std::string text = message.text(); !text.empty()) terminal::tell("{}---\n", text);
  });
  return messages > 0 ? host::kOk : host::kFailed;
}

int rate(const client::WatchOptions& options) {
  client::Intervals intervals;
  watch(options, [&intervals](const client::WatchedMessage& message) { intervals.add(message.received_realtime_ns); });
  const auto figures = intervals.figures();
  if (!figures) return host::kFailed;
  terminal::tell("{}: {:.3f} Hz over {} intervals; interval min {:.6f} s, max {:.6f} s, standard deviation {:.6f} s\n",
                 options.topic, 1.0 / figures->mean_s, figures->count, figures->least_s, figures->most_s,
                 figures->deviation_s);
  return host::kOk;
}

int delay(const client::WatchOptions& options) {
  host::LatencyHistogram delays;
  bool stamped = false;
  watch(options, [&](const client::WatchedMessage& message) {
    const auto delay_s = message.delay_s();
    if (!delay_s) return;
    stamped = true;
    delays.add(*delay_s);
  });
  if (!stamped) {
    terminal::tell(stderr, "{}: no message with a publish time\n", options.topic);
    return host::kFailed;
  }
  terminal::tell(
      "{}: publish to receipt p50 {:.3f} ms, p99 {:.3f} ms, max {:.3f} ms (of two hosts: as good as their clocks "
      "agree)\n",
      options.topic, delays.quantile_s(0.5) * 1e3, delays.quantile_s(0.99) * 1e3, delays.max_s() * 1e3);
  return host::kOk;
}

}  // namespace

void add_topics(CLI::App& app, std::function<int()>& action) {
  CLI::App* topics = app.add_subcommand("topics", "Look at what is on the bus");
  topics->require_subcommand(1);
  const auto add = [&](const char* name, const char* purpose, int (*work)(const client::WatchOptions&),
                       bool of_one_topic, double seconds) {
    auto options = std::make_shared<client::WatchOptions>();
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

}  // namespace inslab::commands
