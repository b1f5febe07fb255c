#pragma once

#include <cstddef>
#include <memory>

#include "dds/fast_dds_network.hpp"

namespace inslab::dds {

/// Whether Fast DDS can read this RTPS message without ending the process. Debian builds it with assertions, and one of
/// them (2.9.1 and 3.1.2 alike, RTPSStatisticsMessages.hpp) demands of a message of Fast DDS that its statistics
/// submessage is the last one: one datagram from anybody, without keys and without discovery, would end the process.
bool is_harmless(const unsigned char* message, std::size_t size);

/// The transport of `transport`, with every message that is not harmless left out of what it receives.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport);

}  // namespace inslab::dds
