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

/// Knows the readers of a writer, and which of them count: not those of onlookers. A reader may be matched a little
/// before its participant's announcement has been heard here; until then it counts for nobody.
struct UntypedWriter::Listener : efd::DataWriterListener {
  Listener(const Participant& participant, std::string topic_name)
      : peers(participant.peers()), own(participant.key()), topic(std::move(topic_name)) {}

  void on_publication_matched(efd::DataWriter*, const efd::PublicationMatchedStatus& status) override {
    ReaderKey reader{};
    for (std::size_t i = 0; i < reader.size(); ++i) reader[i] = status.last_subscription_handle.value[i];
    const std::lock_guard<std::mutex> lock(mutex);
    if (status.current_count_change < 0) {
      readers.erase(reader);
    } else {
      readers.insert(reader);
    }
    count();
  }
  void on_offered_incompatible_qos(efd::DataWriter*, const efd::OfferedIncompatibleQosStatus& status) override {
    spdlog::warn("a reader of {} cannot match our writer: {} at fault; 'inslab doctor' says more", topic,
                 policy_name(static_cast<int>(status.last_policy_id)));
  }

  int matched() {
    if (some_unknown) {
      const std::lock_guard<std::mutex> lock(mutex);
      count();
    }
    return counted;
  }
  int matched_of(const ParticipantKey& participant) {
    const std::lock_guard<std::mutex> lock(mutex);
    return static_cast<int>(std::count_if(readers.begin(), readers.end(), [&participant](const ReaderKey& reader) {
      return participant_of(reader) == participant;
    }));
  }

 private:
  using ReaderKey = std::array<std::uint8_t, 16>;  ///< its GUID

  static ParticipantKey participant_of(const ReaderKey& reader) {
    ParticipantKey key{};
    std::copy_n(reader.begin(), key.size(), key.begin());
    return key;
  }
  void count() {
    int that_count = 0;
    bool unknown = false;
    for (const ReaderKey& reader : readers) {
      const ParticipantKey participant = participant_of(reader);
      const auto peer = peers.find(participant);
      const bool is_own = participant == own;
      if (is_own || (peer && !looks_on(*peer))) ++that_count;
      if (!is_own && !peer) unknown = true;
    }
    counted = that_count;
    some_unknown = unknown;
  }

  const Peers& peers;
  const ParticipantKey own;
  const std::string topic;
  std::mutex mutex;
  std::set<ReaderKey> readers;
  std::atomic<int> counted{0};
  std::atomic<bool> some_unknown{false};
};

UntypedWriter::UntypedWriter(Participant& participant, efd::Topic& topic, const efd::DataWriterQos& qos)
    : publisher_(participant.publisher()),
      announcements_(participant.announcements()),
      listener_(std::make_unique<Listener>(participant, topic.get_name())) {
  writer_ = publisher_.create_datawriter(&topic, qos, listener_.get());
  if (writer_ == nullptr) throw std::runtime_error("Fast DDS makes no writer of " + topic.get_name());
  announcements_.add(*writer_);
}

UntypedWriter::~UntypedWriter() {
  announcements_.remove(*writer_);
  publisher_.delete_datawriter(writer_);
}

bool UntypedWriter::write(const void* sample) {
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    if (writer_->write(const_cast<void*>(sample), fast_dds::Handle()) == efd::RETCODE_OK) return true;
  }
  return false;
}

int UntypedWriter::matched_readers() const { return listener_->matched(); }
int UntypedWriter::matched_readers_of(const ParticipantKey& participant) const {
  return listener_->matched_of(participant);
}

bool UntypedWriter::wait_for_acknowledgments(std::chrono::nanoseconds timeout) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  return writer_->wait_for_acknowledgments(efd::Duration_t(static_cast<std::int32_t>(seconds.count()),
                                                           static_cast<std::uint32_t>((timeout - seconds).count()))) ==
         efd::RETCODE_OK;
}

}  // namespace inslab::dds
