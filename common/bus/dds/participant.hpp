#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/bus/dds/announcements.hpp"
#include "inslab/bus/dds/fast_dds.hpp"
#include "inslab/bus/dds/peers.hpp"
#include "inslab/bus/dds/standstill_watch.hpp"
#include "inslab/bus/dds/type_adapter.hpp"
#include "inslab/bus/dds/typed_topics.hpp"

namespace eprosima::fastdds::dds {
class Publisher;
class Subscriber;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace inslab::dds {

enum class Transport {
  Udp,      ///< UDP over IPv4 alone, big socket buffers: the default, and the one for containers
  Shm,      ///< shared memory, with UDP for discovery and for other hosts
  Default,  ///< what Fast DDS has by itself, or what an XML profile says
};

struct ParticipantOptions {
  std::string name;          ///< the service's
  std::uint32_t domain = 0;  ///< 0 to 232
  std::string unit;          ///< becomes the partition; empty: none
  Transport transport = Transport::Udp;
  std::string interface_address = "127.0.0.1";  ///< IPv4 address to bind to; empty: every interface
  std::vector<std::string> peers;               ///< hosts to look for by unicast instead of multicast
  std::string discovery_server;                 ///< ADDRESS:PORT of a discovery server with id 0; empty: none
  std::string security;                         ///< folder of keys, see bus/dds/security.hpp; empty: none
  std::string role;                             ///< whose keys
  std::vector<std::uint8_t> user_data;          ///< what it says of itself in its announcement
  bool looks_on = false;                        ///< it says instead that its readers count for nobody
};

/// A writer or reader of one of our topics whose type is of another version than ours: it will never match.
struct OtherVersion {
  ParticipantKey participant{};
  bool is_writer = false;
  std::string topic;
  std::string type;
};

/// What keeps `participants` such participants from the shared memory that their transports need, and what to do about
/// it; empty when there is enough or none is needed. One that runs short later is ended by the kernel (SIGBUS).
std::string shared_memory_shortage(ParticipantOptions options, int participants);

/// The settings of a participant: transport and discovery from the options, or from an XML profile when the environment
/// names one (FASTRTPS_DEFAULT_PROFILES_FILE or, as 3.x calls it, FASTDDS_DEFAULT_PROFILES_FILE). Its UDP transports
/// leave aside datagrams that Fast DDS had better not read (bus/dds/datagram_guard.hpp), and count them in `refused`.
/// Throws std::runtime_error when there is too little shared memory for them.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(
    const ParticipantOptions& options, const std::shared_ptr<std::atomic<std::uint32_t>>& refused);

/// One DDS participant of a process, with one publisher and one subscriber. Writers and readers hold on to it. When the
/// process has stood still for so long that others may have forgotten it, all of them are announced once more.
class Participant {
 public:
  /// Throws std::runtime_error when Fast DDS refuses (a domain out of range, no such interface, no free ports) and when
  /// there is too little shared memory for its transports.
  explicit Participant(const ParticipantOptions& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  const ParticipantOptions& options() const { return options_; }

  eprosima::fastdds::dds::DomainParticipant& dds() const { return *participant_; }
  eprosima::fastdds::dds::Publisher& publisher() const { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() const { return *subscriber_; }

  /// Its writers and readers are to be in there for as long as they are.
  Announcements& announcements() { return announcements_; }
  /// The topic of that name and type, both registered at their first use and kept until the end. Throws
  /// std::runtime_error when Fast DDS refuses.
  template <class T>
  eprosima::fastdds::dds::Topic& topic(const std::string& name) {
    return topic_of_type(name, std::string(catalog::WireType<T>::name));
  }

  /// Its own key among the participants of the network.
  ParticipantKey key() const;
  /// The other participants on the network.
  const Peers& peers() const;
  /// Who was heard since the last call of having another version of our types, in this unit.
  std::vector<OtherVersion> take_other_versions();
  /// Whether what a writer (its GUID) sends is not for us: its partition is a pattern, so that it speaks to every unit.
  bool ignores(const std::array<std::uint8_t, 16>& writer) const;

  /// Received samples of any topic whose bytes were not what their type says, and datagrams that were not read.
  std::uint32_t refused_messages() const { return refused_->load(); }

 private:
  struct Listener;

  eprosima::fastdds::dds::Topic& topic_of_type(const std::string& name, const std::string& type_name);

  ParticipantOptions options_;
  std::unique_ptr<Listener> listener_;
  std::shared_ptr<std::atomic<std::uint32_t>> refused_ = std::make_shared<std::atomic<std::uint32_t>>();
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  Announcements announcements_;
  std::unique_ptr<StandstillWatch> standstill_;
};

}  // namespace inslab::dds
