#pragma once

#include <deque>
#include <memory>
#include <variant>
#include <vector>

#include "app/mailbox.hpp"
#include "app/service.hpp"
#include "app/status_board.hpp"
#include "app/stream_monitor.hpp"
#include "dds/reader.hpp"
#include "samples/any_profile.hpp"
#include "samples/run_control.hpp"

namespace inslab::app {

/// What a service that makes sensor data of truth does with it.
class TruthConsumer {
 public:
  virtual ~TruthConsumer() = default;

  /// An entry of the journal, of any sensor.
  virtual void add(const AnyProfile& entry) = 0;
  /// Whether all entries in effect for this sample have come.
  virtual bool ready_for(const TruthState& truth) const = 0;
  /// Computes and sends what follows from one truth sample; they come in order, each once.
  virtual void process(const TruthState& truth) = 0;
  /// Whether each output has a reader.
  virtual bool outputs_matched() const = 0;
  /// Adds the counters of the outputs.
  virtual void report(ServiceStatus& status) const = 0;
  /// Waits until the readers of the outputs have everything.
  virtual void flush(std::chrono::nanoseconds timeout) = 0;
};

/// Follows one run: reads truth, journal and run state, holds a truth sample back until the journal is complete for it,
/// and ends when the run has ended and its last sample is processed. Callbacks enqueue; run() is the one worker.
class TruthFollower {
 public:
  TruthFollower(Context& context, std::uint32_t sensor_number, TruthConsumer& consumer);

  /// Returns the exit code.
  int run();

 private:
  struct Truth {
    TruthState state;
    std::int64_t received_realtime_ns;
  };
  using Message = std::variant<Truth, AnyProfile, SimStatus>;

  template <class Profile>
  void read_journal(dds::Participant& participant);
  void handle(Message message);
  void process_pending();
  void watch_the_journal();
  bool matched() const;
  bool finished() const;
  int end();

  TruthConsumer& consumer_;
  StreamMonitor truth_monitor_;
  Mailbox<Message> mailbox_;
  std::deque<TruthState> pending_;  ///< truth samples that wait for the journal
  time::Nanoseconds pending_since_{0};
  bool stalled_ = false;
  RunId run_id_;
  bool run_ended_ = false;
  std::uint64_t truth_samples_of_run_ = 0;
  time::Nanoseconds run_ended_at_{0};
  StatusBoard board_;
  struct JournalReader {
    std::shared_ptr<void> reader;
    std::function<bool()> matched;
  };
  std::vector<JournalReader> journal_readers_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<TruthState> truth_reader_;
};

}  // namespace inslab::app
