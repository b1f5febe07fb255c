#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "app/mailbox.hpp"
#include "app/service.hpp"
#include "app/status_board.hpp"
#include "app/stream_monitor.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "services/truth_logger/run_log.hpp"

namespace inslab::logger {

/// The logger on the bus: writes everything it hears to the log as it came over the wire, counts every stream, and ends
/// when the run has ended and what the services say they sent is there. A full disk is said in its status and its exit
/// code; it goes on reading, so the streams never wait for it.
class LoggerOnBus {
 public:
  LoggerOnBus(app::Context& context, const std::string& path);

  /// Returns the exit code.
  int run();

 private:
  struct Message {
    std::size_t channel;
    std::vector<std::uint8_t> bytes;
    std::int64_t received_realtime_ns;
  };
  struct Channel {
    std::uint16_t log_id = 0;
    std::string topic;
    std::function<void(const Message&)> take;        ///< logs a message
    std::function<void(const Message&)> on_message;  ///< what it means to the logger besides
    std::uint32_t count = 0;
    std::function<bool()> matched;
    std::shared_ptr<void> reader;
  };

  enum class Writers { Ours, Anybody };

  template <class T>
  Channel& add_reader(app::Context& context, const dds::Topic<T>& topic, Writers writers);
  template <class T>
  Channel& add_channel(app::Context& context, const dds::Topic<T>& topic, Writers writers = Writers::Ours);
  template <class T>
  Channel& add_singles(app::Context& context, const dds::Topic<T>& topic);
  template <class T>
  void add_stream(app::Context& context, const dds::Topic<T>& topic);
  bool note(app::StreamMonitor& monitor, const StreamHeader& header, const Message& message);
  void log(const Channel& channel, const StreamHeader& header, const Message& message,
           const std::vector<std::uint8_t>& cdr);
  void give_credit(const std::string& topic, std::uint64_t next_sequence, bool resend);
  void repeat_credits();
  template <class Profile>
  void add_profile_channels(app::Context& context);
  void add_vehicle_channels(app::Context& context);
  void add_control_channels(app::Context& context);

  void handle(const Message& message);
  void note_failure(const std::string& what);
  bool matched() const;
  std::string unfinished_services() const;
  bool all_services_ended() const;
  bool all_samples_here() const;
  bool finished() const;
  int end();

  app::Context& context_;
  RunLog log_;
  std::string failure_;
  app::Mailbox<Message> mailbox_{200'000};
  std::vector<Channel> channels_;
  std::map<std::string, app::StreamMonitor> streams_;
  std::vector<std::uint8_t> encoded_;
  RunId run_id_;
  ClockMode clock_ = ClockMode::RealTime;
  time::Nanoseconds next_credits_{0};          ///< CLOCK_MONOTONIC
  std::map<std::string, std::uint64_t> sent_;  ///< by topic, as the services report when they have finished
  struct Heard {
    ServiceState state;
    time::Nanoseconds at;  ///< CLOCK_MONOTONIC
  };
  std::map<std::pair<std::string, std::uint32_t>, Heard> services_;
  bool run_ended_ = false;
  time::Nanoseconds run_ended_at_{0};
  app::StatusBoard board_;
  dds::Writer<Credit> credits_;
};

}  // namespace inslab::logger
