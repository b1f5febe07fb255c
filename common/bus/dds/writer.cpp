#include "inslab/bus/dds/writer.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <mutex>
#include <set>

#include "inslab/bus/dds/endpoint.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;

struct UntypedWriter::Listener : efd::DataWriterListener {
  Listener(const Peers& of, std::string topic_name) : peers(of), topic(std::move(topic_name)) {}

  void on_publication_matched(efd::DataWriter*, const efd::PublicationMatchedStatus& status) override {
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
  void on_offered_incompatible_qos(efd::DataWriter*, const efd::OfferedIncompatibleQosStatus& status) override {
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

UntypedWriter::UntypedWriter(Participant& participant, efd::Topic& topic, const efd::DataWriterQos& qos)
    : publisher_(participant.publisher()),
      listener_(std::make_unique<Listener>(participant.peers(), topic.get_name())) {
  writer_ = publisher_.create_datawriter(&topic, qos, listener_.get());
  if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + listener_->topic);
}

UntypedWriter::~UntypedWriter() { publisher_.delete_datawriter(writer_); }

bool UntypedWriter::write(const void* sample) {
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    if (writer_->write(const_cast<void*>(sample), fast_dds::Handle()) == efd::RETCODE_OK) return true;
  }
  return false;
}

int UntypedWriter::matched_readers() const { return listener_->matched.load(); }

bool UntypedWriter::wait_for_acknowledgments(std::chrono::nanoseconds timeout) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  return writer_->wait_for_acknowledgments(efd::Duration_t(static_cast<std::int32_t>(seconds.count()),
                                                           static_cast<std::uint32_t>((timeout - seconds).count()))) ==
         efd::RETCODE_OK;
}

}  // namespace inslab::dds
