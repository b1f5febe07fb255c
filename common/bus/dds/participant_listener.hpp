#pragma once

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "inslab/bus/dds/fast_dds_network.hpp"
#include "inslab/bus/dds/participant.hpp"
#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/fields/unit_name.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::dds {

/// Hears of other participants, of writers and readers whose type is of another version, and finds those who speak to
/// every unit at once: partitions match by pattern, and no unit is called by one.
struct Participant::Listener : fast_dds::DomainParticipantListener {
  explicit Listener(std::string unit_name) : unit(std::move(unit_name)) {}

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::ParticipantStatus status,
                                const fast_dds::ParticipantData& data, bool&) override {
    const ParticipantKey key = key_of(data.guid);
    if (status == fast_dds::ParticipantStatus::REMOVED_PARTICIPANT ||
        status == fast_dds::ParticipantStatus::DROPPED_PARTICIPANT) {
      peers.forget(key);
    } else {
      peers.note({key, text::shown(data.participant_name.to_string()), address_of(data.metatraffic_locators),
                  data.user_data.data_vec()});
    }
  }
  void on_data_writer_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::WriterStatus status,
                                const fast_dds::PublicationData& data, bool& should_be_ignored) override {
    look_at_the_type(data, true);
    look_at_the_partition(data, status == fast_dds::WriterStatus::REMOVED_WRITER, should_be_ignored);
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
    if (topic.rfind(catalog::kRoot, 0) != 0 || type.rfind(catalog::kModule, 0) == 0) return;
    const std::vector<std::string> partitions = data.partition.getNames();
    const bool in_this_unit =
        unit.empty() ? partitions.empty() : std::find(partitions.begin(), partitions.end(), unit) != partitions.end();
    const std::lock_guard<std::mutex> lock(mutex);
    const OtherVersion other{key_of(data.guid), is_writer, topic, type};
    if (in_this_unit && other_versions.size() < kMost) other_versions.push_back(other);
  }

  void look_at_the_partition(const fast_dds::PublicationData& data, bool is_gone, bool& should_be_ignored) {
    WriterKey writer{};
    std::copy_n(data.guid.guidPrefix.value, 12, writer.begin());
    std::copy_n(data.guid.entityId.value, 4, writer.begin() + 12);
    const std::vector<std::string> names = data.partition.getNames();
    const auto pattern = std::find_if(names.begin(), names.end(),
                                      [](const std::string& name) { return !name.empty() && !is_unit_name(name); });
    const std::lock_guard<std::mutex> lock(mutex);
    if (is_gone || pattern == names.end()) {
      ignored.erase(writer);
    } else if (ignored.insert(writer).second) {
      should_be_ignored = true;
      spdlog::warn("a writer of {} in the partition '{}', which is no unit's name, is ignored",
                   text::shown(data.topic_name.to_string()), text::shown(*pattern));
    }
    ignored_count = ignored.size();
  }

  using WriterKey = std::array<std::uint8_t, 16>;  ///< its GUID

  const std::string unit;
  Peers peers;
  std::mutex mutex;
  std::vector<OtherVersion> other_versions;
  std::set<WriterKey> ignored;
  std::atomic<std::size_t> ignored_count{0};
};

}  // namespace inslab::dds
