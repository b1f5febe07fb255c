#include "inslab/bus/dds/datagram_guard.hpp"

#include <algorithm>

namespace inslab::dds {

namespace {

constexpr std::size_t kRtpsHeaderBytes = 20;
constexpr std::size_t kSubmessageHeaderBytes = 4;
/// Where the header has the GUID prefix of who sends it.
constexpr std::size_t kSenderOffset = 8;
constexpr std::size_t kGuidPrefixBytes = 12;
constexpr std::uint8_t kEprosima[2] = {0x01, 0x0f};
/// sizeof of the body of Fast DDS's own submessage of network statistics.
constexpr std::size_t kStatisticsBytes = 56;

enum SubmessageId : std::uint8_t {
  kPad = 0x01,
  kAcknack = 0x06,
  kHeartbeat = 0x07,
  kGap = 0x08,
  kInfoTimestamp = 0x09,
  kNackFrag = 0x12,
  kHeartbeatFrag = 0x13,
  kData = 0x15,
  kDataFrag = 0x16,
  kSecBody = 0x30,
  kSecPrefix = 0x31,
  kSecPostfix = 0x32,
  kSrtpsPrefix = 0x33,
  kSrtpsPostfix = 0x34,
  kStatistics = 0x80,
};

enum EntityId : std::uint32_t {
  kUnknownEntity = 0x00000000,
  kParticipantWriter = 0x000100c2,  ///< announces that a participant is there
  kParticipantReader = 0x000100c7,
  kStatelessWriter = 0x000201c3,  ///< carries the handshake of the authentication
  kStatelessReader = 0x000201c4,
};

struct Submessage {
  std::uint8_t id = 0;
  std::uint8_t flags = 0;
  const std::uint8_t* body = nullptr;
  std::size_t size = 0;

  bool is_little_endian() const { return (flags & 0x01) != 0; }
  std::uint32_t number(std::size_t offset) const {
    const std::uint8_t* b = body + offset;
    return is_little_endian() ? little(b) : big(b);
  }
  /// Entity ids, and the lengths inside protected submessages, do not follow the flag.
  std::uint32_t big_endian(std::size_t offset) const { return big(body + offset); }

 private:
  static std::uint32_t big(const std::uint8_t* b) {
    return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
  }
  static std::uint32_t little(const std::uint8_t* b) {
    return std::uint32_t{b[3]} << 24 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[1]} << 8 | b[0];
  }
};

bool is_of_an_endpoint(std::uint8_t id) {
  return id == kData || id == kDataFrag || id == kHeartbeat || id == kHeartbeatFrag || id == kGap || id == kAcknack ||
         id == kNackFrag;
}

/// Numbers near the end of their range, on which Fast DDS asserts, and gaps that it would count through, one by one,
/// for hours. Data, acknowledgements and fragments have one number, heartbeats and gaps the first and the last.
bool has_absurd_sequence_number(const Submessage& submessage) {
  // 2^60 samples take 36 000 years at 1 MHz. No history of ours spans 2^24: that is 4.6 h of one at 1 kHz.
  constexpr std::uint64_t kMaxNumber = std::uint64_t{1} << 60, kMaxGap = std::uint64_t{1} << 24;
  const auto number_at = [&submessage](std::size_t offset) -> std::uint64_t {
    if (offset + 8 > submessage.size) return 1;
    return std::uint64_t{submessage.number(offset)} << 32 | submessage.number(offset + 4);
  };
  const std::uint64_t first = number_at(submessage.id == kData || submessage.id == kDataFrag ? 12 : 8);
  const bool has_two = submessage.id == kHeartbeat || submessage.id == kGap;
  const std::uint64_t last = has_two ? number_at(16) : first;
  return first > kMaxNumber || last > kMaxNumber || (submessage.id == kGap && last > first && last - first > kMaxGap);
}

/// What the parameters that come before the data say of somebody or something that is gone. Parameters that cannot be
/// read count as a farewell: nobody who announces himself sends any.
struct Parameters {
  bool say_farewell = false;
  const std::uint8_t* key = nullptr;  ///< GUID of whom they are about; null: they do not say
};

Parameters parameters_of(const Submessage& submessage) {
  constexpr std::uint8_t kInlineQosFlag = 0x02, kDataFlag = 0x04;
  constexpr std::uint32_t kKeyHash = 0x0070, kStatusInfo = 0x0071, kSentinel = 0x0001, kGuidBytes = 16;
  Parameters found;
  int keys = 0;
  if (submessage.id == kData && (submessage.flags & kDataFlag) == 0) found.say_farewell = true;
  if ((submessage.flags & kInlineQosFlag) == 0) return found;
  const auto half = [&submessage](std::size_t offset) -> std::uint32_t {
    const std::uint8_t* b = submessage.body + offset;
    return submessage.is_little_endian() ? std::uint32_t{b[1]} << 8 | b[0] : std::uint32_t{b[0]} << 8 | b[1];
  };
  std::size_t offset = 4 + half(2);
  while (offset + 4 <= submessage.size) {
    const std::uint32_t parameter = half(offset), bytes = half(offset + 2);
    if (parameter == kSentinel) return found;
    if (parameter == kStatusInfo) found.say_farewell = true;
    if (parameter == kKeyHash) {
      // Of two keys nobody knows which one is believed.
      const bool is_whole = bytes == kGuidBytes && offset + 4 + bytes <= submessage.size;
      found.key = ++keys == 1 && is_whole ? submessage.body + offset + 4 : nullptr;
    }
    offset += 4 + bytes;
  }
  return {true, nullptr};
}

DatagramFault judge_announcement(const Submessage& submessage, const std::uint8_t* sender) {
  const Parameters parameters = parameters_of(submessage);
  if (!parameters.say_farewell) return DatagramFault::None;
  const bool of_the_sender = parameters.key != nullptr && std::equal(sender, sender + kGuidPrefixBytes, parameters.key);
  return of_the_sender ? DatagramFault::DisposalOfTheSender : DatagramFault::UnprotectedDisposal;
}

/// Of data, heartbeat, gap or acknowledgement in the clear, in a set whose governance demands that they be encrypted.
DatagramFault judge_unprotected(const Submessage& submessage, const std::uint8_t* sender) {
  const bool is_data = submessage.id == kData || submessage.id == kDataFrag;
  const std::size_t ids = is_data ? 4 : 0;
  if (submessage.size < ids + 8) return DatagramFault::UnprotectedSubmessage;
  const std::uint32_t reader = submessage.big_endian(ids);
  const std::uint32_t writer = submessage.big_endian(ids + 4);
  if (is_data && writer == kParticipantWriter && (reader == kUnknownEntity || reader == kParticipantReader)) {
    return judge_announcement(submessage, sender);
  }
  if (is_data && writer == kStatelessWriter && (reader == kUnknownEntity || reader == kStatelessReader)) {
    return DatagramFault::None;
  }
  return DatagramFault::UnprotectedSubmessage;
}

/// Fast DDS 2.9.1 decrypts as many bytes as the body itself says, wherever the datagram ends.
bool is_unsound(const Submessage& submessage) {
  const bool is_protection = submessage.id >= kSecBody && submessage.id <= kSrtpsPostfix;
  if (!is_protection) return false;
  if (submessage.size % 4 != 0) return true;
  return submessage.id == kSecBody && (submessage.size < 4 || submessage.big_endian(0) > submessage.size - 4);
}

}  // namespace

std::string_view text(DatagramFault fault) {
  switch (fault) {
    case DatagramFault::None:
      return "nothing";
    case DatagramFault::MisplacedStatistics:
      return "a statistics submessage in a place that would end this process";
    case DatagramFault::AbsurdSequenceNumber:
      return "a sequence number that no writer reaches";
    case DatagramFault::UnprotectedSubmessage:
      return "data, a heartbeat or an acknowledgement in the clear, in a set with keys";
    case DatagramFault::UnprotectedDisposal:
    case DatagramFault::DisposalOfTheSender:
      return "somebody's farewell in the clear, in a set with keys";
    case DatagramFault::UnsoundProtection:
      return "an encrypted part whose lengths contradict each other";
  }
  return "";
}

DatagramFault judge(const std::uint8_t* datagram, std::size_t size, Protection protection) {
  if (size < kRtpsHeaderBytes) return DatagramFault::None;
  const bool of_fast_dds = datagram[6] == kEprosima[0] && datagram[7] == kEprosima[1];
  std::size_t position = kRtpsHeaderBytes;
  while (position + kSubmessageHeaderBytes <= size) {
    Submessage submessage;
    submessage.id = datagram[position];
    submessage.flags = datagram[position + 1];
    submessage.body = datagram + position + kSubmessageHeaderBytes;
    const std::size_t rest = size - position - kSubmessageHeaderBytes;
    const std::uint8_t low = datagram[position + 2], high = datagram[position + 3];
    submessage.size = submessage.is_little_endian() ? std::size_t{high} << 8 | low : std::size_t{low} << 8 | high;
    if (submessage.size > rest) return DatagramFault::None;
    const bool is_last = submessage.size == 0 && submessage.id != kInfoTimestamp && submessage.id != kPad;
    if (is_last) submessage.size = rest;

    if (submessage.id == kStatistics && of_fast_dds && submessage.size == kStatisticsBytes && submessage.size != rest) {
      return DatagramFault::MisplacedStatistics;
    }
    if (is_of_an_endpoint(submessage.id)) {
      if (has_absurd_sequence_number(submessage)) return DatagramFault::AbsurdSequenceNumber;
      if (protection == Protection::Secured) {
        const DatagramFault fault = judge_unprotected(submessage, datagram + kSenderOffset);
        if (fault != DatagramFault::None) return fault;
      }
    }
    if (protection == Protection::Secured && is_unsound(submessage)) return DatagramFault::UnsoundProtection;
    if (is_last) break;
    position += kSubmessageHeaderBytes + ((submessage.size + 3) & ~std::size_t{3});
  }
  return DatagramFault::None;
}

}  // namespace inslab::dds
