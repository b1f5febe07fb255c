#include "dds/discovery.hpp"

#include <fastdds/rtps/builtin/data/ReaderProxyData.h>
#include <fastdds/rtps/builtin/data/WriterProxyData.h>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <sstream>

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

template <class Text>
std::string text_of(const Text& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// What the announcements of a writer and of a reader have in common.
template <class Proxy>
Endpoint endpoint_of(const Proxy& proxy, bool is_writer) {
  Endpoint endpoint;
  endpoint.is_writer = is_writer;
  endpoint.topic = proxy.topicName().to_string();
  endpoint.type = proxy.typeName().to_string();
  endpoint.guid_prefix = text_of(proxy.guid().guidPrefix);
  endpoint.reliable = proxy.m_qos.m_reliability.kind == efd::RELIABLE_RELIABILITY_QOS;
  endpoint.transient_local = proxy.m_qos.m_durability.kind >= efd::TRANSIENT_LOCAL_DURABILITY_QOS;
  for (const std::string& name : proxy.m_qos.m_partition.getNames()) endpoint.partitions.push_back(name);
  for (const auto id : proxy.m_qos.representation.m_value) endpoint.representations.push_back(id);
  return endpoint;
}

bool share_a_partition(const Endpoint& a, const Endpoint& b) {
  if (a.partitions.empty() && b.partitions.empty()) return true;
  return std::any_of(a.partitions.begin(), a.partitions.end(), [&b](const std::string& name) {
    return std::find(b.partitions.begin(), b.partitions.end(), name) != b.partitions.end();
  });
}

}  // namespace

bool Endpoint::speaks_xcdr1() const {
  return representations.empty() || std::find(representations.begin(), representations.end(),
                                              static_cast<int>(efd::XCDR_DATA_REPRESENTATION)) != representations.end();
}

std::string mismatch(const Endpoint& writer, const Endpoint& reader) {
  if (writer.type != reader.type) return "type: the writer has " + writer.type + ", the reader " + reader.type;
  if (!share_a_partition(writer, reader)) return "partition: they have none in common (--unit)";
  if (reader.reliable && !writer.reliable)
    return "reliability: the reader asks for RELIABLE, the writer is BEST_EFFORT";
  if (reader.transient_local && !writer.transient_local) {
    return "durability: the reader asks for TRANSIENT_LOCAL, the writer is VOLATILE";
  }
  // A writer uses the first of its representations; without a list that is XCDR1.
  const int offered =
      writer.representations.empty() ? static_cast<int>(efd::XCDR_DATA_REPRESENTATION) : writer.representations.front();
  const bool accepted = reader.representations.empty()
                            ? offered == static_cast<int>(efd::XCDR_DATA_REPRESENTATION)
                            : std::find(reader.representations.begin(), reader.representations.end(), offered) !=
                                  reader.representations.end();
  if (!accepted) return "data representation: the reader does not accept what the writer sends";
  return "";
}

struct Discovery::Listener : efd::DomainParticipantListener {
  void on_participant_discovery(efd::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) override {
    const std::lock_guard<std::mutex> lock(mutex);
    const std::string prefix = text_of(info.info.m_guid.guidPrefix);
    const bool gone = info.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
                      info.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT;
    if (gone) {
      participants.erase(prefix);
    } else {
      participants[prefix] = info.info.m_participantName.to_string();
    }
  }
  void on_publisher_discovery(efd::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    const bool gone = info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER;
    note(text_of(info.info.guid()), gone, endpoint_of(info.info, true));
  }
  void on_subscriber_discovery(efd::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override {
    const bool gone = info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER;
    note(text_of(info.info.guid()), gone, endpoint_of(info.info, false));
  }
  void note(const std::string& guid, bool gone, Endpoint endpoint) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (gone) {
      endpoints.erase(guid);
    } else {
      endpoints[guid] = std::move(endpoint);
    }
  }

  mutable std::mutex mutex;
  std::map<std::string, Endpoint> endpoints;
  std::map<std::string, std::string> participants;
};

Discovery::Discovery(const ParticipantOptions& options) : listener_(std::make_unique<Listener>()) {
  participant_ = efd::DomainParticipantFactory::get_instance()->create_participant(
      options.domain, participant_qos(options), listener_.get(), efd::StatusMask::none());
  if (participant_ == nullptr)
    throw std::runtime_error("no DDS participant on domain " + std::to_string(options.domain));
}

Discovery::~Discovery() {
  participant_->set_listener(nullptr);
  efd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

std::vector<Endpoint> Discovery::endpoints() const {
  const std::lock_guard<std::mutex> lock(listener_->mutex);
  std::vector<Endpoint> list;
  for (const auto& [guid, endpoint] : listener_->endpoints) {
    list.push_back(endpoint);
    const auto name = listener_->participants.find(endpoint.guid_prefix);
    if (name != listener_->participants.end()) list.back().participant = name->second;
  }
  std::sort(list.begin(), list.end(), [](const Endpoint& a, const Endpoint& b) { return a.topic < b.topic; });
  return list;
}

std::map<std::string, std::string> Discovery::participants() const {
  const std::lock_guard<std::mutex> lock(listener_->mutex);
  return listener_->participants;
}

}  // namespace inslab::dds
