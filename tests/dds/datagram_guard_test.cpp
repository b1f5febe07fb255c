#include "inslab/bus/dds/datagram_guard.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace inslab::dds {
namespace datagram_guard_test {

using Bytes = std::vector<std::uint8_t>;

enum class Order { Little, Big };

/// A datagram as Fast DDS sends them, submessage by submessage.
class Datagram {
 public:
  explicit Datagram(std::uint8_t vendor = 0x0f) : bytes_{'R', 'T', 'P', 'S', 2, 3, 1, vendor} {
    bytes_.resize(20, 0x66);
  }

  Datagram& add(std::uint8_t id, const Bytes& body, std::uint8_t flags = 0, Order order = Order::Little) {
    const auto size = static_cast<std::uint16_t>(body.size());
    const auto low = static_cast<std::uint8_t>(size), high = static_cast<std::uint8_t>(size >> 8);
    bytes_.push_back(id);
    bytes_.push_back(static_cast<std::uint8_t>(flags | (order == Order::Little ? 1 : 0)));
    bytes_.push_back(order == Order::Little ? low : high);
    bytes_.push_back(order == Order::Little ? high : low);
    bytes_.insert(bytes_.end(), body.begin(), body.end());
    return *this;
  }
  Datagram& cut(std::size_t bytes) {
    bytes_.resize(bytes_.size() - bytes);
    return *this;
  }

  const Bytes& bytes() const { return bytes_; }
  DatagramFault in(Protection protection) const { return judge(bytes_.data(), bytes_.size(), protection); }

 private:
  Bytes bytes_;
};

Bytes entity(std::uint32_t id) {
  return {static_cast<std::uint8_t>(id >> 24), static_cast<std::uint8_t>(id >> 16), static_cast<std::uint8_t>(id >> 8),
          static_cast<std::uint8_t>(id)};
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Bytes kNumberOne{0, 0, 0, 0, 1, 0, 0, 0};
constexpr std::uint32_t kOurWriter = 0x00000103, kOurReader = 0x00000204;
constexpr std::uint32_t kParticipantWriter = 0x000100c2, kHandshakeWriter = 0x000201c3;
constexpr std::uint8_t kData = 0x15, kHeartbeat = 0x07, kAcknack = 0x06, kGap = 0x08, kStatistics = 0x80;
constexpr std::uint8_t kHasData = 0x04, kHasInlineQos = 0x02;

Bytes heartbeat(std::uint32_t writer) {
  return entity(0) + entity(writer) + kNumberOne + kNumberOne + Bytes{1, 0, 0, 0};
}
Bytes data(std::uint32_t writer, const Bytes& rest = {0, 1, 0, 0}) {
  return Bytes{0, 0, 16, 0} + entity(0) + entity(writer) + kNumberOne + rest;
}
/// A parameter list of one parameter and its end.
Bytes parameter(std::uint8_t id) { return {id, 0, 4, 0, 0, 0, 0, 3, 1, 0, 0, 0}; }

TEST(DatagramGuard, WhatIsNoRtpsIsLeftToFastDds) {
  EXPECT_EQ(judge(nullptr, 0, Protection::Secured), DatagramFault::None);
  const Bytes noise(19, 0x80);
  EXPECT_EQ(judge(noise.data(), noise.size(), Protection::Secured), DatagramFault::None);
}

TEST(DatagramGuard, StatisticsAtTheEndAreGood) {
  EXPECT_EQ(Datagram().add(kHeartbeat, heartbeat(kOurWriter)).add(kStatistics, Bytes(56)).in(Protection::Open),
            DatagramFault::None);
}

TEST(DatagramGuard, TheDatagramThatEndsFastDdsIsNotRead) {
  // 57 bytes after a header that says 56: the first byte beyond trips an assertion.
  EXPECT_EQ(Datagram().add(kStatistics, Bytes(56)).add(0, {}).in(Protection::Open), DatagramFault::MisplacedStatistics);
  EXPECT_EQ(Datagram().add(kStatistics, Bytes(56), 0, Order::Big).add(0, {}).cut(3).in(Protection::Open),
            DatagramFault::MisplacedStatistics);
  EXPECT_EQ(Datagram()
                .add(kHeartbeat, heartbeat(kOurWriter))
                .add(kStatistics, Bytes(56))
                .add(0x01, Bytes(4))
                .in(Protection::Secured),
            DatagramFault::UnprotectedSubmessage)
      << "the first fault counts";
}

TEST(DatagramGuard, TheSameBytesOfAnotherVendorMeanSomethingElse) {
  EXPECT_EQ(Datagram(0x10).add(kStatistics, Bytes(56)).add(0, {}).in(Protection::Open), DatagramFault::None);
}

TEST(DatagramGuard, NoNumberNearTheEndOfItsRange) {
  const Bytes last_low_word{0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0xff};
  const Bytes negative{0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0};
  const Bytes ids = entity(kOurReader) + entity(kOurWriter);
  for (const Bytes& number : {last_low_word, negative}) {
    EXPECT_EQ(Datagram().add(kHeartbeat, ids + number + kNumberOne + Bytes(4)).in(Protection::Open),
              DatagramFault::AbsurdSequenceNumber);
    EXPECT_EQ(Datagram().add(kHeartbeat, ids + kNumberOne + number + Bytes(4)).in(Protection::Open),
              DatagramFault::AbsurdSequenceNumber);
    EXPECT_EQ(Datagram().add(kGap, ids + kNumberOne + number + Bytes(8)).in(Protection::Open),
              DatagramFault::AbsurdSequenceNumber);
    EXPECT_EQ(Datagram().add(kAcknack, ids + number + Bytes(8)).in(Protection::Open),
              DatagramFault::AbsurdSequenceNumber);
    EXPECT_EQ(Datagram().add(kData, Bytes{0, 0, 16, 0} + ids + number + Bytes(8), kHasData).in(Protection::Open),
              DatagramFault::AbsurdSequenceNumber);
  }
}

TEST(DatagramGuard, NoGapWiderThanAHistory) {
  const auto gap = [](const Bytes& end) {
    return entity(kOurReader) + entity(kOurWriter) + kNumberOne + end + Bytes(4);
  };
  EXPECT_EQ(Datagram().add(kGap, gap({0, 0, 0, 0, 0, 0, 0, 1})).in(Protection::Open), DatagramFault::None);
  EXPECT_EQ(Datagram().add(kGap, gap({0, 0, 0, 0, 2, 0, 0, 1})).in(Protection::Open),
            DatagramFault::AbsurdSequenceNumber);
}

TEST(DatagramGuard, InAnOpenSetStreamsAreInTheClear) {
  EXPECT_EQ(
      Datagram().add(kData, data(kOurWriter), kHasData).add(kHeartbeat, heartbeat(kOurWriter)).in(Protection::Open),
      DatagramFault::None);
}

TEST(DatagramGuard, InASecuredSetNoSubmessageOfAnEndpointIs) {
  for (const std::uint8_t id : Bytes{0x06, 0x07, 0x08, 0x12, 0x13}) {
    EXPECT_EQ(Datagram().add(id, entity(kOurReader) + entity(kOurWriter) + Bytes(28)).in(Protection::Secured),
              DatagramFault::UnprotectedSubmessage)
        << int{id};
  }
  for (const std::uint8_t id : Bytes{0x15, 0x16}) {
    EXPECT_EQ(Datagram().add(id, data(kOurWriter), kHasData).in(Protection::Secured),
              DatagramFault::UnprotectedSubmessage);
    EXPECT_EQ(Datagram().add(id, {}).in(Protection::Secured), DatagramFault::UnprotectedSubmessage) << "too short";
  }
}

TEST(DatagramGuard, NorBehindAnEncryptedOne) {
  EXPECT_EQ(Datagram()
                .add(0x31, Bytes(20))
                .add(0x30, Bytes{0, 0, 0, 8} + Bytes(8))
                .add(0x32, Bytes(20))
                .add(kHeartbeat, heartbeat(kOurWriter))
                .in(Protection::Secured),
            DatagramFault::UnprotectedSubmessage);
}

TEST(DatagramGuard, EncryptedOnesAndTheWayThereAreGood) {
  EXPECT_EQ(Datagram()
                .add(0x0e, Bytes(12))
                .add(0x09, Bytes(8))
                .add(0x31, Bytes(20))
                .add(0x30, Bytes{0, 0, 0, 8} + Bytes(8))
                .add(0x32, Bytes(20))
                .add(kStatistics, Bytes(56))
                .in(Protection::Secured),
            DatagramFault::None);
  EXPECT_EQ(Datagram()
                .add(0x33, Bytes(20))
                .add(0x30, Bytes{0, 0, 0, 8} + Bytes(8))
                .add(0x34, Bytes(20))
                .add(kStatistics, Bytes(56))
                .in(Protection::Secured),
            DatagramFault::None);
  EXPECT_EQ(Datagram().add(kData, data(kParticipantWriter), kHasData).in(Protection::Secured), DatagramFault::None);
  EXPECT_EQ(Datagram().add(kData, data(kHandshakeWriter), kHasData).in(Protection::Secured), DatagramFault::None);
}

TEST(DatagramGuard, NorOneOfDiscoveryOnceTheHandshakeIsOver) {
  EXPECT_EQ(Datagram().add(kData, data(0x000003c2), kHasData).in(Protection::Secured),
            DatagramFault::UnprotectedSubmessage);
  EXPECT_EQ(Datagram().add(kHeartbeat, heartbeat(kParticipantWriter)).in(Protection::Secured),
            DatagramFault::UnprotectedSubmessage);
  EXPECT_EQ(Datagram().add(kHeartbeat, heartbeat(kHandshakeWriter)).in(Protection::Secured),
            DatagramFault::UnprotectedSubmessage);
}

TEST(DatagramGuard, InASecuredSetNobodyIsSaidToBeGone) {
  EXPECT_EQ(Datagram()
                .add(kData, data(kParticipantWriter, parameter(0x71) + Bytes(4)), kHasData | kHasInlineQos)
                .in(Protection::Secured),
            DatagramFault::UnprotectedDisposal);
  EXPECT_EQ(Datagram().add(kData, data(kParticipantWriter)).in(Protection::Secured), DatagramFault::UnprotectedDisposal)
      << "without data";
  EXPECT_EQ(Datagram().add(kData, data(kParticipantWriter, Bytes(3)), kHasData | kHasInlineQos).in(Protection::Secured),
            DatagramFault::UnprotectedDisposal)
      << "parameters without an end";
  EXPECT_EQ(Datagram()
                .add(kData, data(kParticipantWriter, parameter(0x70) + Bytes(4)), kHasData | kHasInlineQos)
                .in(Protection::Secured),
            DatagramFault::None);
}

/// Anybody may say so in the name of another one: who leaves does it, and it is told apart later (farewells_test.cpp).
TEST(DatagramGuard, WhoSaysThatHeIsGoneHimselfIsToldApart) {
  const Bytes own = Bytes(12, 0x66) + Bytes{0, 0, 1, 0xc1}, others = Bytes(12, 0x67) + Bytes{0, 0, 1, 0xc1};
  const Bytes key{0x70, 0, 16, 0};
  const auto farewell = [](const Bytes& keys) {
    return Datagram()
        .add(kData, data(kParticipantWriter, keys + parameter(0x71)), kHasInlineQos)
        .in(Protection::Secured);
  };
  EXPECT_EQ(farewell(key + own), DatagramFault::DisposalOfTheSender);
  EXPECT_EQ(farewell(key + others), DatagramFault::UnprotectedDisposal);
  EXPECT_EQ(farewell(key + own + key + others), DatagramFault::UnprotectedDisposal) << "two keys";
  EXPECT_EQ(farewell(Bytes{0x70, 0, 12, 0} + Bytes(12, 0x66)), DatagramFault::UnprotectedDisposal) << "half a key";
}

TEST(DatagramGuard, AnEncryptedBodyIsNoLongerThanItsSubmessage) {
  EXPECT_EQ(Datagram().add(0x31, Bytes(20)).add(0x30, Bytes{0, 0, 1, 0} + Bytes(8)).in(Protection::Secured),
            DatagramFault::UnsoundProtection);
  EXPECT_EQ(Datagram().add(0x31, Bytes(21)).in(Protection::Secured), DatagramFault::UnsoundProtection);
}

TEST(DatagramGuard, NothingIsReadBeyondADatagramThatIsCutAnywhere) {
  // The address sanitizer sees a read beyond the end of a block of exactly that size.
  const Datagram whole = Datagram()
                             .add(0x31, Bytes(20))
                             .add(0x30, Bytes{0, 0, 0, 8} + Bytes(8))
                             .add(kData, data(kParticipantWriter, parameter(0x70)), kHasData | kHasInlineQos)
                             .add(kGap, entity(0) + entity(kOurWriter) + kNumberOne + kNumberOne)
                             .add(kStatistics, Bytes(56));
  for (std::size_t size = 0; size <= whole.bytes().size(); ++size) {
    const Bytes cut(whole.bytes().begin(), whole.bytes().begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(judge(cut.data(), cut.size(), Protection::Open), DatagramFault::MisplacedStatistics) << size;
    judge(cut.data(), cut.size(), Protection::Secured);
  }
}

TEST(DatagramGuard, EveryFaultHasItsWords) {
  for (int i = 0; i <= static_cast<int>(DatagramFault::UnsoundProtection); ++i) {
    EXPECT_FALSE(text(static_cast<DatagramFault>(i)).empty()) << i;
  }
}

}  // namespace datagram_guard_test
}  // namespace inslab::dds
