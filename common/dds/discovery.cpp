#include "dds/discovery.hpp"

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <sstream>

#include "dds/fast_dds_network.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;

namespace {

template <class Text>
std::string text_of(const Text& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// What the announcements of a writer and of a reader have in common.
template <class Data>
Endpoint endpoint_of(const Data& data, bool is_writer) {
  Endpoint endpoint;
  endpoint.is_writer = is_writer;
  endpoint.topic = data.topic_name.to_string();
  endpoint.type = data.type_name.to_string();
  endpoint.guid_prefix = text_of(data.guid.guidPrefix);
  endpoint.reliable = data.reliability.kind == efd::RELIABLE_RELIABILITY_QOS;
  endpoint.transient_local = data.durability.kind >= efd::TRANSIENT_LOCAL_DURABILITY_QOS;
  for (const std::string& name : data.partition.getNames()) endpoint.partitions.push_back(name);
  for (const auto id : data.representation.m_value) endpoint.representations.push_back(id);
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

struct Discovery::Listener : fast_dds::DomainParticipantListener {
  void on_participant_discovery(efd::DomainParticipant*, fast_dds::ParticipantStatus status,
                                const fast_dds::ParticipantData& data, bool&) override {
    const std::lock_guard<std::mutex> lock(mutex);
    const std::string prefix = text_of(data.guid.guidPrefix);
    const bool gone = status == fast_dds::ParticipantStatus::REMOVED_PARTICIPANT ||
                      status == fast_dds::ParticipantStatus::DROPPED_PARTICIPANT;
    if (gone) {
      participants.erase(prefix);
    } else {
      participants[prefix] = data.participant_name.to_string();
    }
  }
  void on_data_writer_discovery(efd::DomainParticipant*, fast_dds::WriterStatus status,
                                const fast_dds::PublicationData& data, bool&) override {
    note(text_of(data.guid), status == fast_dds::WriterStatus::REMOVED_WRITER, endpoint_of(data, true));
  }
  void on_data_reader_discovery(efd::DomainParticipant*, fast_dds::ReaderStatus status,
                                const fast_dds::SubscriptionData& data, bool&) override {
    note(text_of(data.guid), status == fast_dds::ReaderStatus::REMOVED_READER, endpoint_of(data, false));
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
