#include "inslab/bus/dds/reader.hpp"

#include <spdlog/spdlog.h>

#include <atomic>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include "inslab/bus/dds/endpoint.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;

struct UntypedReader::Listener : efd::DataReaderListener {
  Listener(Participant& of, std::string topic_name, void* into, Taken on_sample)
      : participant(of), topic(std::move(topic_name)), sample(into), taken(std::move(on_sample)) {}

  void on_data_available(efd::DataReader* reader) override {
    efd::SampleInfo info;
    while (reader->take_next_sample(sample, &info) == efd::RETCODE_OK) {
      if (!info.valid_data) continue;
      SampleOrigin origin;
      const auto& writer = info.sample_identity.writer_guid();
      std::copy(writer.guidPrefix.value, writer.guidPrefix.value + 12, origin.writer.begin());
      std::copy(writer.entityId.value, writer.entityId.value + 4, origin.writer.begin() + 12);
      origin.number = info.sample_identity.sequence_number().to64long();
      origin.written_realtime_ns = info.source_timestamp.to_ns();
      if (!participant.ignores(origin.writer)) taken(origin);
    }
  }
  void on_subscription_matched(efd::DataReader*, const efd::SubscriptionMatchedStatus& status) override {
    matched.store(status.current_count);
  }
  void on_requested_incompatible_qos(efd::DataReader*, const efd::RequestedIncompatibleQosStatus& status) override {
    spdlog::warn("a writer of {} cannot match our reader: {} at fault; 'inslab doctor' says more", topic,
                 policy_name(static_cast<int>(status.last_policy_id)));
  }
  void on_sample_lost(efd::DataReader*, const efd::SampleLostStatus& status) override {
    lost.store(static_cast<std::uint64_t>(status.total_count));
  }

  Participant& participant;
  std::string topic;
  void* sample;
  Taken taken;
  std::atomic<int> matched{0};
  std::atomic<std::uint64_t> lost{0};
};

UntypedReader::UntypedReader(Participant& participant, efd::Topic& topic, const efd::DataReaderQos& qos, void* sample,
                             Taken taken)
    : subscriber_(participant.subscriber()),
      announcements_(participant.announcements()),
      listener_(std::make_unique<Listener>(participant, topic.get_name(), sample, std::move(taken))) {
  reader_ = subscriber_.create_datareader(&topic, qos, listener_.get());
  if (reader_ == nullptr) throw std::runtime_error("Fast DDS makes no reader of " + listener_->topic);
  announcements_.add(*reader_);
}

UntypedReader::~UntypedReader() {
  // First no more callbacks, then no more reader: the callback's target may go right after this.
  announcements_.remove(*reader_);
  reader_->set_listener(nullptr);
  subscriber_.delete_datareader(reader_);
}

int UntypedReader::matched_writers() const { return listener_->matched.load(); }

std::uint64_t UntypedReader::lost() const { return listener_->lost.load(); }

}  // namespace inslab::dds
