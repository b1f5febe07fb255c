#pragma once

/// Transports, and what is heard of others, under the names of Fast DDS 3.x; see bus/dds/fast_dds.hpp.

#include <chrono>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <vector>

#include "inslab/bus/dds/fast_dds.hpp"

#ifdef INSLAB_FAST_DDS_3
#include <fastdds/rtps/attributes/RTPSParticipantAttributes.hpp>
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/builtin/data/ReaderProxyData.h>
#include <fastdds/rtps/builtin/data/WriterProxyData.h>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>

namespace eprosima::fastdds::rtps {
using DiscoveryProtocol = fastrtps::rtps::DiscoveryProtocol_t;
// NOLINTBEGIN(misc-unused-using-decls): for those who include this
using fastrtps::rtps::IPLocator;
using fastrtps::rtps::Locator_t;
using fastrtps::rtps::octet;
using fastrtps::rtps::SenderResource;
// NOLINTEND(misc-unused-using-decls)
}  // namespace eprosima::fastdds::rtps
#endif

namespace inslab::dds::fast_dds {

/// A transport that passes on what another one sends and receives, but for what it chooses to leave out.
class ChainedTransport : public eprosima::fastdds::rtps::ChainingTransport {
 public:
  using Sender = eprosima::fastdds::rtps::SenderResource;
  using Locators = eprosima::fastdds::rtps::LocatorsIterator;
  using Deadline = std::chrono::steady_clock::time_point;
  using ChainingTransport::ChainingTransport;

#ifdef INSLAB_FAST_DDS_3
  bool send(Sender* sender, const std::vector<eprosima::fastdds::rtps::NetworkBuffer>& buffers, std::uint32_t size,
            Locators* begin, Locators* end, const Deadline& deadline) override {
    return sender->send(buffers, size, begin, end, deadline);
  }
#else
  bool send(Sender* sender, const eprosima::fastdds::rtps::octet* buffer, std::uint32_t size, Locators* begin,
            Locators* end, const Deadline& deadline) override {
    return sender->send(buffer, size, begin, end, deadline);
  }
#endif
};

#ifdef INSLAB_FAST_DDS_3

template <class DiscoverySettings>
void add_discovery_server(DiscoverySettings& settings, const eprosima::fastdds::rtps::Locator& address) {
  settings.m_DiscoveryServers.push_back(address);
}

using DomainParticipantListener = eprosima::fastdds::dds::DomainParticipantListener;
using ParticipantData = eprosima::fastdds::dds::ParticipantBuiltinTopicData;
using PublicationData = eprosima::fastdds::dds::PublicationBuiltinTopicData;
using SubscriptionData = eprosima::fastdds::dds::SubscriptionBuiltinTopicData;
using ParticipantStatus = eprosima::fastdds::rtps::ParticipantDiscoveryStatus;
using WriterStatus = eprosima::fastdds::rtps::WriterDiscoveryStatus;
using ReaderStatus = eprosima::fastdds::rtps::ReaderDiscoveryStatus;

#else

template <class DiscoverySettings>
void add_discovery_server(DiscoverySettings& settings, const eprosima::fastdds::rtps::Locator& address) {
  eprosima::fastrtps::rtps::RemoteServerAttributes server;
  server.ReadguidPrefix("44.53.00.5f.45.50.52.4f.53.49.4d.41");  // Fast DDS's own name for the server with id 0
  server.metatrafficUnicastLocatorList.push_back(address);
  settings.m_DiscoveryServers.push_back(server);
}

struct ParticipantData {
  const eprosima::fastdds::rtps::GUID_t& guid;
  const eprosima::fastrtps::string_255& participant_name;
  const eprosima::fastdds::dds::UserDataQosPolicy& user_data;
  const eprosima::fastrtps::rtps::RemoteLocatorList& metatraffic_locators;
};

/// Of a writer or a reader.
struct EndpointData {
  const eprosima::fastrtps::string_255& topic_name;
  const eprosima::fastrtps::string_255& type_name;
  const eprosima::fastdds::rtps::GUID_t& guid;
  const eprosima::fastdds::dds::DurabilityQosPolicy& durability;
  const eprosima::fastdds::dds::DeadlineQosPolicy& deadline;
  const eprosima::fastdds::dds::LatencyBudgetQosPolicy& latency_budget;
  const eprosima::fastdds::dds::LivelinessQosPolicy& liveliness;
  const eprosima::fastdds::dds::ReliabilityQosPolicy& reliability;
  const eprosima::fastdds::dds::OwnershipQosPolicy& ownership;
  const eprosima::fastdds::dds::DestinationOrderQosPolicy& destination_order;
  const eprosima::fastdds::dds::PresentationQosPolicy& presentation;
  const eprosima::fastdds::dds::PartitionQosPolicy& partition;
  const eprosima::fastdds::dds::DataRepresentationQosPolicy& representation;
  const eprosima::fastdds::dds::UserDataQosPolicy& user_data;

  template <class Proxy>
  explicit EndpointData(const Proxy& proxy)
      : topic_name(proxy.topicName()),
        type_name(proxy.typeName()),
        guid(proxy.guid()),
        durability(proxy.m_qos.m_durability),
        deadline(proxy.m_qos.m_deadline),
        latency_budget(proxy.m_qos.m_latencyBudget),
        liveliness(proxy.m_qos.m_liveliness),
        reliability(proxy.m_qos.m_reliability),
        ownership(proxy.m_qos.m_ownership),
        destination_order(proxy.m_qos.m_destinationOrder),
        presentation(proxy.m_qos.m_presentation),
        partition(proxy.m_qos.m_partition),
        representation(proxy.m_qos.representation),
        user_data(proxy.m_qos.m_userData) {}
};
struct PublicationData : EndpointData {
  using EndpointData::EndpointData;
};
struct SubscriptionData : EndpointData {
  using EndpointData::EndpointData;
};

enum class ParticipantStatus {
  DISCOVERED_PARTICIPANT,
  CHANGED_QOS_PARTICIPANT,
  REMOVED_PARTICIPANT,
  DROPPED_PARTICIPANT
};
enum class WriterStatus { DISCOVERED_WRITER, CHANGED_QOS_WRITER, REMOVED_WRITER };
enum class ReaderStatus { DISCOVERED_READER, CHANGED_QOS_READER, REMOVED_READER };

/// A listener with the discovery callbacks of 3.x. 2.9 can ignore nobody: `should_be_ignored` is without effect.
class DomainParticipantListener : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Participant = eprosima::fastdds::dds::DomainParticipant;
  virtual void on_participant_discovery(Participant*, ParticipantStatus, const ParticipantData&, bool&) {}
  virtual void on_data_writer_discovery(Participant*, WriterStatus, const PublicationData&, bool&) {}
  virtual void on_data_reader_discovery(Participant*, ReaderStatus, const SubscriptionData&, bool&) {}

 private:
  void on_participant_discovery(Participant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) final {
    bool ignored = false;
    on_participant_discovery(
        participant, static_cast<ParticipantStatus>(info.status),
        {info.info.m_guid, info.info.m_participantName, info.info.m_userData, info.info.metatraffic_locators}, ignored);
  }
  void on_publisher_discovery(Participant* participant, eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) final {
    bool ignored = false;
    on_data_writer_discovery(participant, static_cast<WriterStatus>(info.status), PublicationData(info.info), ignored);
  }
  void on_subscriber_discovery(Participant* participant, eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) final {
    bool ignored = false;
    on_data_reader_discovery(participant, static_cast<ReaderStatus>(info.status), SubscriptionData(info.info), ignored);
  }
};

#endif

}  // namespace inslab::dds::fast_dds
