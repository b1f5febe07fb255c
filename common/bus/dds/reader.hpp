#pragma once

#include <algorithm>
#include <array>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <functional>
#include <memory>
#include <mutex>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/qos.hpp"
#include "inslab/bus/dds/seen_numbers.hpp"
#include "inslab/bus/dds/type_adapter.hpp"

namespace inslab::dds {

/// Which writer sent a sample, its count there, and when it was written.
struct SampleOrigin {
  std::array<std::uint8_t, 16> writer{};
  std::uint64_t number = 0;
  std::int64_t written_realtime_ns = 0;  ///< by the clock of the writer's host
};

inline ParticipantKey participant_of(const SampleOrigin& origin) {
  ParticipantKey key{};
  std::copy_n(origin.writer.begin(), key.size(), key.begin());
  return key;
}

/// What a Reader does whatever its type: takes every sample into `sample` and calls `taken`.
class UntypedReader {
 public:
  using Taken = std::function<void(const SampleOrigin&)>;

  UntypedReader(Participant& participant, eprosima::fastdds::dds::Topic& topic,
                const eprosima::fastdds::dds::DataReaderQos& qos, void* sample, Taken taken);
  ~UntypedReader();
  UntypedReader(const UntypedReader&) = delete;
  UntypedReader& operator=(const UntypedReader&) = delete;

  int matched_writers() const;
  std::uint64_t lost() const;

 private:
  struct Listener;

  eprosima::fastdds::dds::Subscriber& subscriber_;
  Announcements& announcements_;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
};

/// Typed reader of one topic. The callback runs in a thread of Fast DDS and must only enqueue. The participant outlives
/// the reader.
template <class T>
class Reader {
 public:
  using Callback = std::function<void(const Received<T>&, const SampleOrigin&)>;

  /// Throws std::runtime_error when Fast DDS refuses the topic or its settings.
  Reader(Participant& participant, const Topic<T>& topic, Callback callback,
         Reliability reliability = Reliability::Reliable)
      : callback_(std::move(callback)),
        untyped_(participant, participant.topic<T>(topic.name),
                 reader_qos(topic.delivery, topic.nominal_rate_hz, reliability, topic.is_kept),
                 static_cast<T*>(&sample_), [this](const SampleOrigin& origin) { callback_(sample_, origin); }) {}

  int matched_writers() const { return untyped_.matched_writers(); }
  /// Samples that Fast DDS reports as gone before they could be taken.
  std::uint64_t lost() const { return untyped_.lost(); }

 private:
  Callback callback_;
  Received<T> sample_;
  UntypedReader untyped_;  // the first to go: no callback comes after it
};

/// Reader of what foreigners write: one reliable and one best-effort reader, so that writers of both kinds match and a
/// reliable one is repaired; what arrives at both is handed on once.
template <class T>
class OpenReader {
 public:
  using Callback = typename Reader<T>::Callback;

  OpenReader(Participant& participant, const Topic<T>& topic, Callback callback)
      : callback_(std::move(callback)),
        reliable_(participant, topic, [this](const Received<T>& s, const SampleOrigin& o) { hand_on(s, o); }),
        best_effort_(
            participant, topic, [this](const Received<T>& s, const SampleOrigin& o) { hand_on(s, o); },
            Reliability::BestEffort) {}

  int matched_writers() const { return best_effort_.matched_writers(); }

 private:
  void hand_on(const Received<T>& sample, const SampleOrigin& origin) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!seen_.insert(origin.writer, origin.number)) return;
    }
    callback_(sample, origin);
  }

  Callback callback_;
  std::mutex mutex_;
  SeenSamples seen_;
  Reader<T> reliable_;
  Reader<T> best_effort_;
};

}  // namespace inslab::dds
