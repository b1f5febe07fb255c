#pragma once

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <functional>
#include <mutex>

#include "inslab/bus/dds/endpoint.hpp"
#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/qos.hpp"
#include "inslab/bus/dds/seen_numbers.hpp"
#include "inslab/bus/dds/type_adapter.hpp"

namespace inslab::dds {

/// Which writer sent a sample, and its count there.
struct SampleOrigin {
  std::array<std::uint8_t, 16> writer{};
  std::uint64_t number = 0;
};

inline ParticipantKey participant_of(const SampleOrigin& origin) {
  ParticipantKey key{};
  std::copy_n(origin.writer.begin(), key.size(), key.begin());
  return key;
}

enum class Reliability { Reliable, BestEffort };

/// Typed reader of one topic. The callback runs in a thread of Fast DDS and must only enqueue. The participant outlives
/// the reader.
template <class T>
class Reader {
 public:
  using Callback = std::function<void(const Received<T>&, const SampleOrigin&)>;

  /// Throws std::runtime_error when Fast DDS refuses the topic or its settings.
  Reader(Participant& participant, const Topic<T>& topic, Callback callback,
         Reliability reliability = Reliability::Reliable)
      : subscriber_(participant.subscriber()), listener_(participant, topic.name, std::move(callback)) {
    auto& dds_topic = participant.topic<T>(topic.name);
    auto qos = reader_qos(topic.delivery, topic.nominal_rate_hz);
    if (reliability == Reliability::BestEffort) {
      qos.reliability().kind = eprosima::fastdds::dds::BEST_EFFORT_RELIABILITY_QOS;
    }
    reader_ = subscriber_.create_datareader(&dds_topic, qos, &listener_);
    if (reader_ == nullptr) throw std::runtime_error("Fast DDS makes no reader of " + topic.name);
  }
  ~Reader() {
    // First no more callbacks, then no more reader: the callback's target may go right after this.
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  int matched_writers() const { return listener_.matched.load(); }
  /// Samples that Fast DDS reports as gone before they could be taken.
  std::uint64_t lost() const { return listener_.lost.load(); }

 private:
  struct Listener : eprosima::fastdds::dds::DataReaderListener {
    Listener(Participant& of, std::string topic_name, Callback on_sample)
        : participant(of), topic(std::move(topic_name)), callback(std::move(on_sample)) {}

    void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
      eprosima::fastdds::dds::SampleInfo info;
      while (reader->take_next_sample(static_cast<T*>(&sample), &info) == eprosima::fastdds::dds::RETCODE_OK) {
        if (!info.valid_data) continue;
        SampleOrigin origin;
        const auto& writer = info.sample_identity.writer_guid();
        std::copy(writer.guidPrefix.value, writer.guidPrefix.value + 12, origin.writer.begin());
        std::copy(writer.entityId.value, writer.entityId.value + 4, origin.writer.begin() + 12);
        origin.number = info.sample_identity.sequence_number().to64long();
        if (!participant.ignores(origin.writer)) callback(sample, origin);
      }
    }
    void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                                 const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
      matched.store(status.current_count);
    }
    void on_requested_incompatible_qos(eprosima::fastdds::dds::DataReader*,
                                       const eprosima::fastdds::dds::RequestedIncompatibleQosStatus& status) override {
      spdlog::warn("a writer of {} cannot match our reader: {} at fault; 'inslab doctor' says more", topic,
                   policy_name(static_cast<int>(status.last_policy_id)));
    }
    void on_sample_lost(eprosima::fastdds::dds::DataReader*,
                        const eprosima::fastdds::dds::SampleLostStatus& status) override {
      lost.store(static_cast<std::uint64_t>(status.total_count));
    }

    Participant& participant;
    std::string topic;
    Callback callback;
    Received<T> sample;
    std::atomic<int> matched{0};
    std::atomic<std::uint64_t> lost{0};
  };

  eprosima::fastdds::dds::Subscriber& subscriber_;
  Listener listener_;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
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
