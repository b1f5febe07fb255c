#pragma once

#include <spdlog/spdlog.h>

#include <map>
#include <vector>

#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::service {

/// What came in one message of a stream: one sample, or in lockstep a block of them.
template <class Sample>
struct Arrived {
  std::vector<Sample> samples;
  std::int64_t received_realtime_ns = 0;
};

/// One stream as a consumer reads it, the counterpart of StreamOutput: samples in their order, each once, whether they
/// come singly or in blocks. What is missing is asked for again; what does not come within `patience` is given up. In
/// lockstep it says how far the consumer is, which sets the producer's pace.
///
/// Callbacks hand messages to `enqueue`, in a thread of DDS; all else belongs to the one worker.
template <class Sample>
class StreamInput {
 public:
  StreamInput(Context& context, const dds::Topic<Sample>& topic, std::function<void(Arrived<Sample>)> enqueue)
      : consumer_(context.service()),
        monitor_(topic.name, StreamDirection::In),
        credits_(context.participant(), dds::topics::credit()),
        samples_(context, topic,
                 [enqueue](const Sample& sample, const dds::SampleOrigin&) {
                   enqueue({{sample}, host::realtime_now().count()});
                 }),
        blocks_(context, dds::topics::block(topic), [enqueue](const Block<Sample>& block, const dds::SampleOrigin&) {
          enqueue({block.samples, host::realtime_now().count()});
        }) {}

  void begin_run(const RunId& run, ClockMode clock) {
    run_ = run;
    lockstep_ = clock == ClockMode::Lockstep;
    came_at_ = host::monotonic_now();
    give_credit(0, true);
  }

  void add(const Arrived<Sample>& arrived) {
    for (const Sample& sample : arrived.samples) {
      if (sample.header.run_id != run_) continue;  // its run's status has not come yet: it will be asked for again
      came_at_ = host::monotonic_now();
      monitor_.received(sample.header, arrived.received_realtime_ns);
      if (sample.header.sequence_number >= next_) pending_.insert_or_assign(sample.header.sequence_number, sample);
    }
  }

  /// The next sample in order, or nothing.
  std::optional<Sample> take() {
    if (pending_.empty()) return std::nullopt;
    const auto front = pending_.begin();
    if (front->first > next_ && !gave_up()) return std::nullopt;
    std::optional<Sample> sample(std::move(front->second));
    next_ = front->first + 1;
    gap_since_ = time::Nanoseconds(0);
    pending_.erase(front);
    return sample;
  }

  /// Asks for what is missing, and in lockstep says that nothing before `wanted` is needed again: at once when that has
  /// changed, else now and then, since a credit that got lost must not stop the run.
  void tick(std::uint64_t wanted) {
    if (run_ == RunId{}) return;
    const bool gap = !pending_.empty() && pending_.begin()->first > next_;
    if (gap && gap_since_ == time::Nanoseconds(0)) gap_since_ = host::monotonic_now();
    const bool repeat = host::monotonic_now() >= next_credit_;
    const bool moved = lockstep_ && wanted != wanted_;
    // In lockstep the next block follows upon a credit; one that was sent before this process listened is sent again.
    const bool silent =
        lockstep_ && pending_.empty() && host::monotonic_now() - came_at_ > std::chrono::milliseconds(400);
    const bool lacks = gap || silent;
    if (moved || (repeat && (lacks || lockstep_))) give_credit(gap ? next_ : wanted, lacks && repeat);
  }

  bool matched() const { return samples_.matched_writers() > 0 && blocks_.matched_writers() > 0; }
  std::uint64_t samples() const { return monitor_.samples(); }
  const std::string& topic() const { return monitor_.topic(); }
  StreamStatus status() const { return monitor_.status(); }
  /// Whether samples wait behind one that is missing.
  bool waits() const { return !pending_.empty(); }

 private:
  bool gave_up() const {
    const time::Nanoseconds patience = lockstep_ ? std::chrono::seconds(2) : std::chrono::milliseconds(100);
    return gap_since_ != time::Nanoseconds(0) && host::monotonic_now() - gap_since_ > patience;
  }

  void give_credit(std::uint64_t wanted, bool resend) {
    next_credit_ = host::monotonic_now() + (lockstep_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(20));
    wanted_ = wanted;
    Credit credit;
    credit.run_id = run_;
    credit.consumer = consumer_;
    credit.topic = monitor_.topic();
    credit.next_sequence = wanted;
    credit.resend = resend;
    if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
  }

  std::string consumer_;
  RunId run_;
  bool lockstep_ = false;
  std::uint64_t next_ = 0;
  std::uint64_t wanted_ = 0;
  std::map<std::uint64_t, Sample> pending_;  ///< not taken yet, by sequence number
  time::Nanoseconds gap_since_{0};           ///< CLOCK_MONOTONIC; 0: sample next_ is not missing
  time::Nanoseconds came_at_{0};             ///< CLOCK_MONOTONIC, the newest
  time::Nanoseconds next_credit_{0};
  streams::StreamMonitor monitor_;
  dds::Writer<Credit> credits_;
  SetReader<Sample> samples_;
  SetReader<Block<Sample>> blocks_;
};

}  // namespace inslab::service
