#pragma once

#include <spdlog/spdlog.h>

#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/set_reader.hpp"
#include "inslab/data/streams/receiver.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::service {

/// One stream as a consumer reads it, the counterpart of StreamOutput: samples in their order, each once, whether they
/// come singly or in blocks. What is missing is asked for again, and in the end left out. In lockstep it says how far
/// the consumer is, which sets the producer's pace.
///
/// Callbacks hand messages to `enqueue`, in a thread of DDS; all else belongs to the one worker.
template <class Sample>
class StreamInput {
 public:
  StreamInput(Context& context, const dds::Topic<Sample>& topic,
              const std::function<void(streams::Arrived<Sample>)>& enqueue)
      : consumer_(context.service()),
        receiver_(topic.name),
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
    receiver_.begin_run(run, streams::demand_of_input(clock), host::monotonic_now());
  }

  void add(const streams::Arrived<Sample>& arrived) { receiver_.add(arrived, host::monotonic_now()); }
  /// The next sample in order, or nothing.
  std::optional<Sample> take() { return receiver_.take(host::monotonic_now()); }

  /// Asks for what is missing, and in lockstep says that nothing before `wanted` is needed again: at once when that has
  /// changed, else now and then.
  void tick(std::uint64_t wanted) {
    typename streams::Receiver<Sample>::Consumer consumer;
    consumer.moved = lockstep_ && wanted != wanted_;
    const auto ask = receiver_.look(consumer, host::monotonic_now());
    if (!ask) return;
    wanted_ = wanted;
    Credit credit;
    credit.run_id = run_;
    credit.consumer = consumer_;
    credit.topic = topic();
    credit.next_sequence = ask->resend ? receiver_.next() : wanted;
    credit.resend = ask->resend;
    if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
  }

  bool matched() const { return samples_.matched_writers() > 0 && blocks_.matched_writers() > 0; }
  const std::string& topic() const { return receiver_.monitor().topic(); }
  StreamStatus status() const { return receiver_.monitor().status(); }

 private:
  std::string consumer_;
  RunId run_;
  bool lockstep_ = false;
  std::uint64_t wanted_ = 0;  ///< as it was said last
  streams::Receiver<Sample> receiver_;
  dds::Writer<Credit> credits_;
  SetReader<Sample> samples_;
  SetReader<Block<Sample>> blocks_;
};

}  // namespace inslab::service
