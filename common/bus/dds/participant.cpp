#include "inslab/bus/dds/participant.hpp"

#include <spdlog/spdlog.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "inslab/bus/dds/fast_dds_network.hpp"
#include "inslab/bus/dds/lease_check.hpp"
#include "inslab/bus/dds/packet_guard.hpp"
#include "inslab/bus/dds/participant_listener.hpp"
#include "inslab/bus/dds/security.hpp"
#include "inslab/foundation/fields/unit_name.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;
namespace efr = eprosima::fastdds::rtps;

namespace {

// Asked for; the kernel gives what net.core.rmem_max and wmem_max allow. With the defaults the readers' buffers
// overrun and each hole costs a repair round.
constexpr std::uint32_t kReceiveBufferBytes = 4u << 20;
constexpr std::uint32_t kSendBufferBytes = 1u << 20;
constexpr std::uint32_t kParticipantsOfAPeer = 24;
/// A participant that was not heard for so long is forgotten.
constexpr std::int32_t kLease_s = 10;
constexpr std::uint32_t kShmSegmentBytes = 16u << 20;
constexpr std::uint32_t kShmQueueCapacity = 4096;
/// Of one participant beside its segment: its ports and what Fast DDS keeps with them.
constexpr std::uint64_t kShmBesideSegmentBytes = 1u << 20;
constexpr const char* kShmFolder = "/dev/shm";

/// Fast DDS prints its errors in colour on standard output, one for each packet of a hostile peer: say the first few in
/// our own log.
class LogForwarder : public efd::LogConsumer {
 public:
  void Consume(const efd::Log::Entry& entry) override {
    constexpr int kSaid = 10;
    if (entry.kind != efd::Log::Kind::Error || said_ > kSaid || is_of_a_second_reader(entry.message)) return;
    if (++said_ > kSaid) {
      spdlog::warn("Fast DDS: more errors, not shown");
    } else {
      spdlog::warn("Fast DDS: {}", text::shown(entry.message));
    }
  }

 private:
  /// An OpenReader is two readers: what one of them lacks the other has, or it comes again.
  bool is_of_a_second_reader(const std::string& message) {
    if (!fast_dds::kSecuredSampleComesToOneReader) return false;
    if (message.rfind("Error in fastcdr trying to deserialize SecureDataHeader", 0) == 0) {
      ++second_readers_;
      return true;
    }
    if (second_readers_ == 0 || message.rfind("Error decoding encoded payload", 0) != 0) return false;
    --second_readers_;
    return true;
  }

  int said_ = 0;
  int second_readers_ = 0;  // of which the second error is still to come
};

void forward_fast_dds_log() {
  static const bool done = [] {
    efd::Log::ClearConsumers();
    efd::Log::RegisterConsumer(std::make_unique<LogForwarder>());
    return true;
  }();
  (void)done;
}

std::shared_ptr<efr::UDPv4TransportDescriptor> udp_transport(const std::string& interface_address) {
  auto udp = std::make_shared<efr::UDPv4TransportDescriptor>();
  udp->receiveBufferSize = kReceiveBufferBytes;
  udp->sendBufferSize = kSendBufferBytes;
  udp->non_blocking_send = false;
  // How many participants of a host that is named as a peer are looked for; 4 would miss the fifth service.
  udp->maxInitialPeersRange = kParticipantsOfAPeer;
  if (!interface_address.empty()) udp->interfaceWhiteList.push_back(interface_address);
  return udp;
}

void set_transport(efd::DomainParticipantQos& qos, const ParticipantOptions& options) {
  if (options.transport == Transport::Default) return;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp_transport(options.interface_address));
  if (options.transport == Transport::Shm) {
    auto shm = std::make_shared<efr::SharedMemTransportDescriptor>();
    shm->segment_size(kShmSegmentBytes);
    shm->port_queue_capacity(kShmQueueCapacity);
    qos.transport().user_transports.push_back(shm);
  }
}

efr::Locator udp_locator(const std::string& address, std::uint32_t port) {
  efr::Locator locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  if (!efr::IPLocator::setIPv4(locator, address)) {
    throw std::runtime_error("'" + address + "'; expected an IPv4 address");
  }
  locator.port = port;
  return locator;
}

/// Puts the guard before every UDP transport, those of an XML profile too. Fast DDS's own pair has to be named for
/// that.
void guard_transports(efd::DomainParticipantQos& qos, Protection protection,
                      const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {
  auto& transport = qos.transport();
  if (transport.use_builtin_transports) {
    auto udp = std::make_shared<efr::UDPv4TransportDescriptor>();
    udp->sendBufferSize = transport.send_socket_buffer_size;
    udp->receiveBufferSize = transport.listen_socket_buffer_size;
    auto shm = std::make_shared<efr::SharedMemTransportDescriptor>();
    shm->max_message_size(udp->max_message_size());
    transport.use_builtin_transports = false;
    transport.user_transports.push_back(udp);
    transport.user_transports.push_back(shm);
  }
  for (auto& descriptor : transport.user_transports) {
    if (std::dynamic_pointer_cast<efr::UDPTransportDescriptor>(descriptor)) {
      descriptor = guarded(descriptor, protection, refused);
    }
  }
}

/// Looks for the hosts named, at the ports that their participants would have, and joins no multicast group.
void set_peers(efd::DomainParticipantQos& qos, const ParticipantOptions& options) {
  auto& builtin = qos.wire_protocol().builtin;
  for (const std::string& peer : options.peers) builtin.initialPeersList.push_back(udp_locator(peer, 0));
  // A list of unicast locators of our own replaces the default ones, multicast among them.
  builtin.metatrafficUnicastLocatorList.push_back(efr::Locator());
  builtin.metatrafficUnicastLocatorList.begin()->kind = LOCATOR_KIND_UDPv4;
}

void set_discovery_server(efd::DomainParticipantQos& qos, const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const int port = colon == std::string::npos ? 0 : std::atoi(address.c_str() + colon + 1);
  if (port <= 0 || port > 65535) {
    throw std::runtime_error("discovery server '" + address + "'; expected ADDRESS:PORT");
  }
  auto& config = qos.wire_protocol().builtin.discovery_config;
  config.discoveryProtocol = efr::DiscoveryProtocol::CLIENT;
  fast_dds::add_discovery_server(config, udp_locator(address.substr(0, colon), static_cast<std::uint32_t>(port)));
}

/// The file of XML profiles that the environment names, under this Fast DDS's name or the other's; empty: none.
std::string profiles_file() {
  for (const char* name : {fast_dds::kProfilesVariable, fast_dds::kOtherProfilesVariable}) {
    const char* file = std::getenv(name);
    if (file != nullptr && *file != '\0') return file;
  }
  return "";
}

}  // namespace

namespace {

efd::DomainParticipantQos qos_for(const ParticipantOptions& options,
                                  const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {
  mend_the_lease_check();
  auto& factory = *efd::DomainParticipantFactory::get_instance();
  efd::DomainParticipantQos qos = efd::PARTICIPANT_QOS_DEFAULT;
  if (const std::string xml = profiles_file(); !xml.empty()) {
    // An XML profile has the last word on transport and discovery, and on nothing else.
    setenv(fast_dds::kProfilesVariable, xml.c_str(), 1);
    factory.load_profiles();
    factory.get_default_participant_qos(qos);
  } else {
    set_transport(qos, options);
    qos.wire_protocol().builtin.discovery_config.leaseDuration = efd::Duration_t(kLease_s, 0);
    qos.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod = efd::Duration_t(1, 0);
    if (!options.peers.empty()) set_peers(qos, options);
    if (!options.discovery_server.empty()) set_discovery_server(qos, options.discovery_server);
  }
  guard_transports(qos, options.security.empty() ? Protection::Open : Protection::Secured, refused);
  mend_the_lease_check();
  qos.name(options.name);
  qos.user_data().data_vec(options.looks_on ? onlooker_announcement() : options.user_data);
  if (!options.security.empty()) set_security(qos, options.security, options.role);
  return qos;
}

/// What a participant with these transports takes of the shared memory: those of Fast DDS itself and of an XML profile
/// may have it too.
std::uint64_t shared_memory_bytes(const efd::DomainParticipantQos& qos) {
  std::uint64_t bytes = 0;
  for (const auto& descriptor : qos.transport().user_transports) {
    if (const auto shm = std::dynamic_pointer_cast<efr::SharedMemTransportDescriptor>(descriptor)) {
      bytes += shm->segment_size() + kShmBesideSegmentBytes;
    }
  }
  return bytes;
}

std::string shortage_for(const efd::DomainParticipantQos& qos, int participants) {
  const std::uint64_t needed_bytes = static_cast<std::uint64_t>(participants) * shared_memory_bytes(qos);
  if (needed_bytes == 0) return "";
  struct statvfs place {};
  if (statvfs(kShmFolder, &place) != 0) return std::string(kShmFolder) + ": " + std::strerror(errno);
  const std::uint64_t free_bytes = std::uint64_t{place.f_bavail} * place.f_frsize;
  if (free_bytes >= needed_bytes) return "";
  const auto mb = [](std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
  return std::string(kShmFolder) + " has " + mb(free_bytes) + " left; " + std::to_string(participants) +
         (participants == 1 ? " participant needs " : " participants need ") + mb(needed_bytes) +
         " of shared memory. Use --transport udp, or make it larger: mount -o remount,size=1g /dev/shm, in a "
         "container --shm-size=1g";
}

}  // namespace

std::string shared_memory_shortage(ParticipantOptions options, int participants) {
  options.security.clear();  // keys take none
  return shortage_for(qos_for(options, std::make_shared<std::atomic<std::uint32_t>>()), participants);
}

efd::DomainParticipantQos participant_qos(const ParticipantOptions& options,
                                          const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {
  efd::DomainParticipantQos qos = qos_for(options, refused);
  if (const std::string shortage = shortage_for(qos, 1); !shortage.empty()) throw std::runtime_error(shortage);
  return qos;
}

Participant::Participant(const ParticipantOptions& options)
    : options_(options), listener_(std::make_unique<Listener>(options.unit)) {
  forward_fast_dds_log();
  auto& factory = *efd::DomainParticipantFactory::get_instance();
  if (options.domain > 232) {
    throw std::runtime_error("DDS domain " + std::to_string(options.domain) + "; expected 0 to 232");
  }
  if (!options.unit.empty() && !is_unit_name(options.unit)) {
    throw std::runtime_error("unit '" + text::shown(options.unit) + "'; expected " + kUnitNameRule);
  }
  participant_ = factory.create_participant(options.domain, participant_qos(options, refused_), listener_.get(),
                                            efd::StatusMask::none());
  if (participant_ == nullptr) {
    efd::Log::Flush();  // what Fast DDS says about it comes first
    throw std::runtime_error("no DDS participant on domain " + std::to_string(options.domain) + ", interface '" +
                             options.interface_address + "': does the interface exist, are its ports free" +
                             (options.security.empty() ? "?" : ", may '" + options.role + "' join this domain?"));
  }
  efd::PublisherQos publisher_qos = efd::PUBLISHER_QOS_DEFAULT;
  efd::SubscriberQos subscriber_qos = efd::SUBSCRIBER_QOS_DEFAULT;
  if (!options.unit.empty()) {
    publisher_qos.partition().push_back(options.unit.c_str());
    subscriber_qos.partition().push_back(options.unit.c_str());
  }
  publisher_ = participant_->create_publisher(publisher_qos);
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  standstill_ =
      std::make_unique<StandstillWatch>(std::chrono::seconds(kLease_s / 2), [this] { announcements_.repeat(); });
}

Participant::~Participant() {
  standstill_.reset();
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  efd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

ParticipantKey Participant::key() const { return Listener::key_of(participant_->guid()); }

const Peers& Participant::peers() const { return listener_->peers; }

std::vector<OtherVersion> Participant::take_other_versions() {
  const std::lock_guard<std::mutex> lock(listener_->mutex);
  return std::exchange(listener_->other_versions, {});
}

bool Participant::ignores(const std::array<std::uint8_t, 16>& writer) const {
  if (listener_->ignored_count == 0) return false;
  const std::lock_guard<std::mutex> lock(listener_->mutex);
  return listener_->ignored.count(writer) > 0;
}

efd::Topic& Participant::topic_of_type(const std::string& name, const std::string& type_name) {
  if (participant_->find_type(type_name).empty()) {
    efd::TypeSupport type(type_adapter(type_name, refused_).release());
    if (type.register_type(participant_) != efd::RETCODE_OK) {
      throw std::runtime_error("Fast DDS does not register the type " + type_name);
    }
  }
  if (auto* known = dynamic_cast<efd::Topic*>(participant_->lookup_topicdescription(name))) return *known;
  efd::Topic* topic = participant_->create_topic(name, type_name, efd::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) throw std::runtime_error("no DDS topic " + name);
  return *topic;
}

}  // namespace inslab::dds
