#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "inslab/bus/dds/datagram_guard.hpp"
#include "inslab/bus/dds/fast_dds_network.hpp"

namespace inslab::dds {

/// A transport that hands on no datagram with a fault (bus/dds/datagram_guard.hpp); else it is `transport`, a UDP one.
/// Each faulty datagram is counted in `refused`, and the first of a kind is told in the log with the address it came
/// from; a farewell in the name of who sends it only when it turns out to be forged (bus/dds/farewells.hpp).
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> guarded(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport, Protection protection,
    std::shared_ptr<std::atomic<std::uint32_t>> refused);

}  // namespace inslab::dds
