#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Judges the bytes of a datagram before Fast DDS reads them. Pure: no DDS, no I/O.
///
/// Needed because Fast DDS 2.9.1 does not see to it: it ends the process on a misplaced submessage of its own
/// statistics, counts through a gap of any width, and in a secured set obeys heartbeats and acknowledgements that come
/// in the clear although the governance demands that they be encrypted.
///
/// Source of the layout: OMG DDSI-RTPS 2.5, 8.3 and 9.4; of the protected submessages: OMG DDS Security 1.1, 7.3.6.
namespace inslab::dds {

enum class DatagramFault {
  None,
  MisplacedStatistics,    ///< what ends a Fast DDS 2.9.1: its statistics submessage, not at the very end
  AbsurdSequenceNumber,   ///< beyond any that counting can reach, or a gap wider than any history
  UnprotectedSubmessage,  ///< in a secured set: data, heartbeat, gap or acknowledgement in the clear
  UnprotectedDisposal,    ///< in a secured set: a farewell in anybody's name
  DisposalOfTheSender,    ///< in a secured set: one in the name of who sends it, if he is whom he says he is
  UnsoundProtection,      ///< a protected submessage whose lengths contradict each other
};

/// For a log: what is wrong with the datagram.
std::string_view text(DatagramFault fault);

/// Whether the set is one with keys, whose governance has RTPS protection of kind ENCRYPT.
enum class Protection { Open, Secured };

/// The first fault of a datagram as it came from the network. What is no RTPS at all, or ends in the middle of a
/// submessage, has none: Fast DDS itself leaves that aside.
DatagramFault judge(const std::uint8_t* datagram, std::size_t size, Protection protection);

}  // namespace inslab::dds
