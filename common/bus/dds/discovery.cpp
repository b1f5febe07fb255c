#include "inslab/bus/dds/discovery.hpp"

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <limits>
#include <sstream>

#include "inslab/bus/dds/fast_dds_network.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;

namespace {

template <class Text>
std::string text_of(const Text& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

double seconds_of(const efd::Duration_t& duration) {
  constexpr std::int32_t kForEver = 0x7fffffff;
  return duration.seconds == kForEver ? std::numeric_limits<double>::infinity()
                                      : static_cast<double>(duration.seconds) + 1e-9 * duration.nanosec;
}

/// Ours has the order of DDS, as theirs does. What a stranger announces beyond the last counts as the last.
template <class Kind, class Theirs>
Kind kind_of(Theirs theirs, Kind last) {
  return static_cast<Kind>(std::min(static_cast<int>(theirs), static_cast<int>(last)));
}

/// What the announcements of a writer and of a reader have in common.
template <class Data>
Endpoint endpoint_of(const Data& data, bool is_writer) {
  Endpoint endpoint;
  endpoint.is_writer = is_writer;
  endpoint.topic = text::shown(data.topic_name.to_string());
  endpoint.type = text::shown(data.type_name.to_string());
  endpoint.guid_prefix = text_of(data.guid.guidPrefix);
  const bool reliable = data.reliability.kind == efd::RELIABLE_RELIABILITY_QOS;
  endpoint.reliability = reliable ? ReliabilityKind::Reliable : ReliabilityKind::BestEffort;
  endpoint.durability = kind_of<DurabilityKind>(data.durability.kind, DurabilityKind::Persistent);
  endpoint.deadline_s = seconds_of(data.deadline.period);
  endpoint.latency_budget_s = seconds_of(data.latency_budget.duration);
  endpoint.ownership = kind_of<OwnershipKind>(data.ownership.kind, OwnershipKind::Exclusive);
  endpoint.liveliness = kind_of<LivelinessKind>(data.liveliness.kind, LivelinessKind::ManualByTopic);
  endpoint.liveliness_lease_s = seconds_of(data.liveliness.lease_duration);
  endpoint.destination_order =
      kind_of<DestinationOrderKind>(data.destination_order.kind, DestinationOrderKind::BySourceTimestamp);
  endpoint.presentation = kind_of<PresentationScope>(data.presentation.access_scope, PresentationScope::Group);
  endpoint.coherent_access = data.presentation.coherent_access;
  endpoint.ordered_access = data.presentation.ordered_access;
  for (const std::string& name : data.partition.getNames()) endpoint.partitions.push_back(text::shown(name));
  for (const auto id : data.representation.m_value) endpoint.representations.push_back(id);
  return endpoint;
}

}  // namespace

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
      participants[prefix] = text::shown(data.participant_name.to_string());
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
      options.domain, participant_qos(options, std::make_shared<std::atomic<std::uint32_t>>()), listener_.get(),
      efd::StatusMask::none());
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
