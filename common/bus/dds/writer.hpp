#pragma once

#include <chrono>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <memory>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/qos.hpp"
#include "inslab/bus/dds/type_adapter.hpp"

namespace inslab::dds {

/// What a Writer does whatever its type.
class UntypedWriter {
 public:
  UntypedWriter(Participant& participant, eprosima::fastdds::dds::Topic& topic,
                const eprosima::fastdds::dds::DataWriterQos& qos);
  ~UntypedWriter();
  UntypedWriter(const UntypedWriter&) = delete;
  UntypedWriter& operator=(const UntypedWriter&) = delete;

  bool write(const void* sample);
  int matched_readers() const;
  int matched_readers_of(const ParticipantKey& participant) const;
  bool wait_for_acknowledgments(std::chrono::nanoseconds timeout);

 private:
  struct Listener;

  eprosima::fastdds::dds::Publisher& publisher_;
  Announcements& announcements_;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

/// Typed writer of one topic. The participant outlives it.
template <class T>
class Writer {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic or its settings.
  Writer(Participant& participant, const Topic<T>& topic)
      : untyped_(participant, participant.topic<T>(topic.name),
                 writer_qos(topic.delivery, topic.nominal_rate_hz, topic.is_kept)) {}

  /// Sends one sample. 2.9 refuses one now and then while its history empties; asked again it takes it, so three tries
  /// are made. False when all fail: the sample was not sent.
  bool write(const T& sample) { return untyped_.write(&sample); }

  /// How many readers it has, without those of onlookers: nobody waits for them, and nothing is sent for them alone.
  int matched_readers() const { return untyped_.matched_readers(); }
  /// How many of them are one participant's.
  int matched_readers_of(const ParticipantKey& participant) const { return untyped_.matched_readers_of(participant); }

  /// Waits until all matched reliable readers have acknowledged everything; false after `timeout`.
  bool wait_for_acknowledgments(std::chrono::nanoseconds timeout) { return untyped_.wait_for_acknowledgments(timeout); }

 private:
  UntypedWriter untyped_;
};

}  // namespace inslab::dds
