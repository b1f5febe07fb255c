#pragma once

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <mutex>
#include <set>

#include "dds/endpoint.hpp"
#include "dds/participant.hpp"
#include "dds/qos.hpp"
#include "dds/type_adapter.hpp"

namespace inslab::dds {

/// Typed writer of one topic. The participant outlives it.
template <class T>
class Writer {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic or its settings.
  Writer(Participant& participant, const Topic<T>& topic)
      : publisher_(participant.publisher()), listener_(participant.peers(), topic.name) {
    auto& dds_topic = participant.topic<T>(topic.name);
    writer_ = publisher_.create_datawriter(&dds_topic, writer_qos(topic.delivery, topic.nominal_rate_hz), &listener_);
    if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + topic.name);
  }
  ~Writer() { publisher_.delete_datawriter(writer_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Sends one sample. 2.9 refuses one now and then while its history empties; asked again it takes it, so three tries
  /// are made. False when all fail: the sample was not sent.
  bool write(const T& sample) {
    constexpr int kTries = 3;
    for (int i = 0; i < kTries; ++i) {
      if (writer_->write(const_cast<T*>(&sample), fast_dds::Handle()) == eprosima::fastdds::dds::RETCODE_OK) {
        return true;
      }
    }
    return false;
  }

  /// How many readers it has, without those of onlookers: nobody waits for them, and nothing is sent for them alone.
  int matched_readers() const { return listener_.matched.load(); }

  /// Waits until all matched reliable readers have acknowledged everything; false after `timeout`.
  bool wait_for_acknowledgments(std::chrono::nanoseconds timeout) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
    return writer_->wait_for_acknowledgments(eprosima::fastdds::dds::Duration_t(
               static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>((timeout - seconds).count()))) ==
           eprosima::fastdds::dds::RETCODE_OK;
  }

 private:
  struct Listener : eprosima::fastdds::dds::DataWriterListener {
    Listener(const Peers& of, std::string topic_name) : peers(of), topic(std::move(topic_name)) {}
    void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                                const eprosima::fastdds::dds::PublicationMatchedStatus& status) override {
      ReaderKey reader{};
      for (std::size_t i = 0; i < reader.size(); ++i) reader[i] = status.last_subscription_handle.value[i];
      ParticipantKey key{};
      std::copy_n(reader.begin(), key.size(), key.begin());
      const std::lock_guard<std::mutex> lock(mutex);
      if (status.current_count_change < 0) {
        onlookers.erase(reader);
      } else if (const auto peer = peers.find(key); peer && looks_on(*peer)) {
        onlookers.insert(reader);
      }
      matched.store(status.current_count - static_cast<int>(onlookers.size()));
    }
    void on_offered_incompatible_qos(eprosima::fastdds::dds::DataWriter*,
                                     const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& status) override {
      spdlog::warn("a reader of {} cannot match our writer: {} at fault; 'inslab doctor' says more", topic,
                   policy_name(static_cast<int>(status.last_policy_id)));
    }

    using ReaderKey = std::array<std::uint8_t, 16>;  ///< its GUID

    const Peers& peers;
    std::string topic;
    std::mutex mutex;
    std::set<ReaderKey> onlookers;
    std::atomic<int> matched{0};
  };

  eprosima::fastdds::dds::Publisher& publisher_;
  Listener listener_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

}  // namespace inslab::dds
