#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dds/topics.hpp"

namespace eprosima::fastdds::dds {
class DomainParticipant;
class Publisher;
class Subscriber;
class Topic;
class TypeSupport;
}  // namespace eprosima::fastdds::dds

namespace inslab::dds {

enum class Transport {
  Udp,      ///< UDP over IPv4 alone, big socket buffers: the default, and the one for containers
  Shm,      ///< shared memory, with UDP for discovery and for other hosts
  Default,  ///< what Fast DDS has by itself, or what an XML profile says
};

struct ParticipantOptions {
  std::string name;                     ///< the service's
  std::uint32_t domain = 0;             ///< 0 to 232
  std::string unit;                     ///< becomes the partition; empty: none
  Transport transport = Transport::Udp;
  std::string interface_address = "127.0.0.1";  ///< IPv4 address to bind to; empty: every interface
};

/// One DDS participant of a process, with one publisher and one subscriber. Writers and readers hold on to it.
class Participant {
 public:
  /// Throws std::runtime_error when Fast DDS refuses (a domain out of range, no such interface, no free ports).
  explicit Participant(const ParticipantOptions& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  const ParticipantOptions& options() const { return options_; }

  eprosima::fastdds::dds::DomainParticipant& dds() const { return *participant_; }
  eprosima::fastdds::dds::Publisher& publisher() const { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() const { return *subscriber_; }

  /// The topic of that name, made at its first use and kept until the end; its type is registered already. Throws
  /// std::runtime_error when Fast DDS refuses it.
  eprosima::fastdds::dds::Topic& topic(const std::string& name, const eprosima::fastdds::dds::TypeSupport& type);

 private:
  ParticipantOptions options_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

}  // namespace inslab::dds
