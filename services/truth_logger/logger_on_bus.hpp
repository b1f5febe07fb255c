#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/checkpoint.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/bus/service/status_board.hpp"
#include "inslab/data/streams/demand.hpp"
#include "inslab/data/streams/run_follower.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/host/stop_grace.hpp"
#include "inslab/referee/score/scorer.hpp"
#include "inslab/services/truth_logger/app_messages.hpp"
#include "inslab/sim/log_tail.hpp"
#include "inslab/sim/logger_state.hpp"
#include "inslab/sim/run_log.hpp"

namespace inslab::truth_logger {

/// The logger on the bus: writes everything it hears to the log as it came over the wire, counts every stream, and ends
/// when the run has ended and what the services say they sent is there. It scores the navigation app as it listens. A
/// full disk is said in its status and its exit code; it goes on reading, so the streams never wait for it.
///
/// Killed and started again in the same run it goes on with the same file: what it had taken and not written yet lies
/// in its LogTail, and what has been sent since is asked for again.
class LoggerOnBus {
 public:
  LoggerOnBus(service::Context& context, const std::string& path);

  /// Returns the exit code.
  int run();

 private:
  struct Message {
    std::size_t channel;
    std::vector<std::uint8_t> bytes;
    std::int64_t received_realtime_ns;
    dds::SampleOrigin origin;
    bool follows_what_was_kept =
        false;  ///< it is new, and comes behind what its writer kept for a logger that was away
  };
  /// Whom a stream came from last.
  struct Source {
    dds::ParticipantKey sender{};
    std::int64_t received_realtime_ns = 0;
    std::uint64_t sequence_number = 0;
  };
  /// It takes samples as they come, and has no use for an order.
  struct Stream {
    streams::StreamMonitor monitor;
    streams::Demand demand;
  };
  struct Channel {
    std::uint16_t log_id = 0;
    std::string topic;
    std::function<void(const Message&)> take;        ///< logs a message
    std::function<void(const Message&)> on_message;  ///< what it means to the logger besides
    std::uint32_t count = 0;
    std::function<bool()> matched;
    std::shared_ptr<void> reader;
    std::shared_ptr<void> reader_of_what_is_kept;  ///< by its writer, for a logger that was away
    std::function<bool()> is_kept;                 ///< whether there is such a writer
  };

  enum class Writers { Ours, OneApp, Anybody };

  static std::optional<sim::LoggerState> interrupted(service::Context& context, service::Checkpoint& checkpoint);
  sim::LoggerState state() const;
  void begin_run();
  void open_tail();
  void go_on();
  void flush();

  template <class T>
  Channel& add_reader(service::Context& context, const dds::Topic<T>& topic, Writers writers);
  template <class T>
  Channel& add_channel(service::Context& context, const dds::Topic<T>& topic, Writers writers = Writers::Ours);
  void log_once(Channel& channel);
  template <class T>
  Channel& add_singles(service::Context& context, const dds::Topic<T>& topic);
  template <class T>
  void add_stream(service::Context& context, const dds::Topic<T>& topic);
  void watch_the_sender(const std::string& topic, const StreamHeader& header, const Message& message);
  bool note(Stream& stream, const StreamHeader& header, const Message& message);
  void log(const Channel& channel, const StreamHeader& header, const Message& message,
           const std::vector<std::uint8_t>& cdr);
  void add_score();
  void give_credit(Stream& stream, bool moved);
  void say_of_the_log(bool is_closed);
  void change_demands();
  void look_around();
  void account_for_the_app(bool at_the_end);
  template <class Profile>
  void add_profile_channels(service::Context& context);
  void add_nav_channels(service::Context& context);
  void add_vehicle_channels(service::Context& context);
  void add_control_channels(service::Context& context);

  void handle(const Message& message);
  void take(const Message& message);
  void note_failure(const std::string& what);
  std::string missing() const;
  std::string unfinished_services() const;
  bool all_services_ended() const;
  bool all_samples_here() const;
  bool finished() const;
  int end();

  service::Context& context_;
  service::Checkpoint checkpoint_;
  std::optional<sim::LoggerState> interrupted_;  ///< what another process of this run left
  sim::RunLog log_;
  std::unique_ptr<sim::LogTail> tail_;  ///< null: there is no place for it
  std::uint64_t generation_ = 1;
  std::map<std::string, Source> sources_;
  AppMessages app_messages_;
  std::int64_t listens_since_realtime_ns_ = host::realtime_now().count();
  std::set<std::uint64_t> once_;  ///< hashes of the messages of channels that are logged once
  score::Scorer scorer_;
  std::string failure_;
  host::Mailbox<Message> mailbox_{200'000};
  std::vector<Channel> channels_;
  std::map<std::string, Stream> streams_;
  std::vector<std::uint8_t> encoded_;
  streams::RunFollower run_;
  time::Nanoseconds next_flush_{0};            ///< CLOCK_MONOTONIC
  time::Nanoseconds looked_at_{0};             ///< CLOCK_MONOTONIC
  std::map<std::string, std::uint64_t> sent_;  ///< by topic, as the services report when they have finished
  struct Heard {
    ServiceState state;
    time::Nanoseconds at;  ///< CLOCK_MONOTONIC
  };
  std::map<std::pair<std::string, std::uint32_t>, Heard> services_;
  host::StopGrace grace_;
  service::StatusBoard board_;
  dds::Writer<Credit> credits_;
  /// A word that is said once stays the first in its writer's history. Among credits by the thousand that would leave a
  /// gap as wide as the run, which each reader counts through, one by one, whenever it has missed something.
  dds::Writer<Credit> log_words_;
};

}  // namespace inslab::truth_logger
