#pragma once

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "dds/fast_dds_network.hpp"
#include "dds/participant.hpp"

namespace inslab::dds {

/// Hears of other participants, and of writers and readers whose type is of another version.
struct Participant::Listener : fast_dds::DomainParticipantListener {
  explicit Listener(std::string unit_name) : unit(std::move(unit_name)) {}

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::ParticipantStatus status,
                                const fast_dds::ParticipantData& data, bool&) override {
    const ParticipantKey key = key_of(data.guid);
    if (status == fast_dds::ParticipantStatus::REMOVED_PARTICIPANT ||
        status == fast_dds::ParticipantStatus::DROPPED_PARTICIPANT) {
      peers.forget(key);
    } else {
      peers.note(
          {key, data.participant_name.to_string(), address_of(data.metatraffic_locators), data.user_data.data_vec()});
    }
  }
  void on_data_writer_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::WriterStatus,
                                const fast_dds::PublicationData& data, bool&) override {
    look_at_the_type(data, true);
  }
  void on_data_reader_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::ReaderStatus,
                                const fast_dds::SubscriptionData& data, bool&) override {
    look_at_the_type(data, false);
  }

  template <class Guid>
  static ParticipantKey key_of(const Guid& guid) {
    ParticipantKey key{};
    std::copy_n(guid.guidPrefix.value, key.size(), key.begin());
    return key;
  }
  template <class Locators>
  static std::string address_of(const Locators& locators) {
    for (const auto& locator : locators.unicast) {
      if (locator.kind == LOCATOR_KIND_UDPv4) return eprosima::fastdds::rtps::IPLocator::toIPv4string(locator);
    }
    return "";
  }
  template <class Data>
  void look_at_the_type(const Data& data, bool is_writer) {
    constexpr std::size_t kMost = 64;
    const std::string topic = data.topic_name.to_string();
    const std::string type = data.type_name.to_string();
    if (topic.rfind("inslab/", 0) != 0 || type.rfind(wire::kModule, 0) == 0) return;
    const std::vector<std::string> partitions = data.partition.getNames();
    const bool in_this_unit =
        unit.empty() ? partitions.empty() : std::find(partitions.begin(), partitions.end(), unit) != partitions.end();
    const std::lock_guard<std::mutex> lock(mutex);
    const OtherVersion other{key_of(data.guid), is_writer, topic, type};
    if (in_this_unit && other_versions.size() < kMost) other_versions.push_back(other);
  }

  const std::string unit;
  Peers peers;
  std::mutex mutex;
  std::vector<OtherVersion> other_versions;
};

}  // namespace inslab::dds
