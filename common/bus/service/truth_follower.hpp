#pragma once

#include <exception>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/checkpoint.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/bus/service/status_board.hpp"
#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/streams/receiver.hpp"
#include "inslab/data/streams/run_follower.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/host/stop_grace.hpp"

namespace inslab::service {

/// What a service that makes sensor data of truth does with it.
class TruthConsumer {
 public:
  virtual ~TruthConsumer() = default;

  /// The run that the next truth samples belong to, and what sets its pace.
  virtual void begin_run(const RunId& run, ClockMode clock) = 0;
  /// An entry of the journal, of any sensor.
  virtual void add(const catalog::AnyProfile& entry) = 0;
  /// Whether all entries in effect for this sample have come.
  virtual bool ready_for(const TruthState& truth) const = 0;
  /// Whether the outputs may take what follows from another truth sample; always in real time.
  virtual bool has_room() const = 0;
  /// Computes and sends what follows from one truth sample; they come in order, each once.
  virtual void process(const TruthState& truth) = 0;
  /// The run is over, and no more truth comes of it: says what becomes of swaps under which no sample came out.
  virtual void end_run(const RunId& run) = 0;
  /// Sends what process() has gathered for a block.
  virtual void flush_blocks() = 0;
  /// A credit of any stream: those for the outputs are the consumer's.
  virtual void take(const Credit& credit) = 0;
  /// Sequence numbers that follow the newest sample of each output.
  virtual std::vector<std::uint64_t> outputs_end() const = 0;
  /// Whether every consumer has the outputs up to `ends`, so that none of them will be asked for again.
  virtual bool outputs_delivered(const std::vector<std::uint64_t>& ends) const = 0;
  /// Whether the logger has said that it has everything that was put out.
  virtual bool outputs_logged() const = 0;
  /// The IMU topic that the app under test navigates by, when the scenario lets it set the pace; else empty. The
  /// imu_sequence of its solutions then counts as its credit for that topic.
  virtual std::string paced_by_nav_app() const { return ""; }
  /// What the outputs still wait for before the run may begin; empty when each has its readers.
  virtual std::string missing_readers() const = 0;
  /// What it needs to go on in another process, and going on from that.
  virtual void save(state::StateWriter& writer) const = 0;
  virtual void load(state::StateReader& reader) = 0;
  /// Adds the counters of the outputs.
  virtual void report(ServiceStatus& status) const = 0;
  /// Waits until the readers of the outputs have everything, at the latest until `deadline` (CLOCK_MONOTONIC).
  virtual void flush(time::Nanoseconds deadline) = 0;
};

/// Follows one run: reads truth, journal and run state, holds a truth sample back until the journal is complete for it
/// and the outputs have room, and ends when the run has ended and its last sample is processed. Truth is processed in
/// order, each sample once: what is missing is asked for again. Callbacks enqueue; run() is the one worker. In real
/// time the truth sample that is next, while nothing else waits, is served by the thread that brings it: to wake the
/// worker takes longer than the model. Whoever serves has the turn; a callback never waits for it.
///
/// Before the first truth sample and after each, in lockstep after each block that has been delivered, it keeps a
/// checkpoint. Killed and started again in the same run it goes on from there: it asks for the truth since, and its
/// outputs continue with the same bits. What it cannot have it says, and ends as a fault.
class TruthFollower {
 public:
  TruthFollower(Context& context, std::uint32_t sensor_number, TruthConsumer& consumer);

  /// Returns the exit code.
  int run();

 private:
  using Message = std::variant<streams::Arrived<TruthState>, catalog::AnyProfile, SimStatus, Credit>;
  /// A point up to which the outputs are complete once they are delivered.
  struct Mark {
    std::uint64_t truth_end;
    std::vector<std::uint64_t> outputs_end;
    std::vector<std::uint8_t> checkpoint;
  };

  template <class Profile>
  void read_journal(Context& context);
  void hear(streams::Arrived<TruthState> arrived);
  bool serve_at_once(const streams::Arrived<TruthState>& arrived);
  void handle(Message message);
  void handle(const SimStatus& status);
  void obey(const catalog::AnyProfile& entry);
  void begin_run();
  bool resume();
  std::vector<std::uint8_t> checkpoint() const;
  void add_truth(const streams::Arrived<TruthState>& arrived);
  void process_pending();
  void pace_the_burst();
  void deliver();
  void give_credit(bool moved);
  void watch_the_journal();
  bool readers_are_back();
  bool can_process();
  std::string missing() const;
  bool finished() const;
  void tell_the_wait();
  void stay_for_the_log();
  std::string lost() const;
  int follow();
  int fail(const std::string& reason);
  int end();

  Context& context_;
  std::string service_;
  std::uint32_t sensor_number_;
  TruthConsumer& consumer_;
  host::Mailbox<Message> mailbox_;
  std::mutex turn_;              ///< all that follows, and the consumer, belong to whoever has it
  bool serves_at_once_ = false;  ///< while run() follows a run
  std::exception_ptr failure_;   ///< of who served at once, for the worker to tell
  streams::RunFollower run_;
  streams::Receiver<TruthState> truth_;
  Checkpoint checkpoint_;
  std::vector<Mark> marks_;             ///< processed, but not yet delivered
  std::uint64_t delivered_ = 0;         ///< truth samples before this one are never needed again
  time::Nanoseconds waiting_since_{0};  ///< CLOCK_MONOTONIC: no sample was processed since, no journal entry came
  time::Nanoseconds resumed_at_{0};     ///< CLOCK_MONOTONIC; 0: everybody reads what this process sends
  bool stalled_ = false;
  std::uint64_t burst_ = 0;  ///< samples processed since this process last had done with all that had come
  host::StopGrace grace_;
  StatusBoard board_;
  dds::Writer<Credit> credits_;
  struct JournalReader {
    std::shared_ptr<void> reader;
    std::function<bool()> matched;
  };
  std::vector<JournalReader> journal_readers_;
  std::unique_ptr<dds::OpenReader<NavSolution>> nav_reader_;
  SetReader<SimStatus> status_reader_;
  SetReader<Credit> credit_reader_;
  SetReader<TruthState> truth_reader_;
  SetReader<Block<TruthState>> block_reader_;
};

}  // namespace inslab::service
