#include "dds/packet_guard.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "dds/reader.hpp"
#include "dds/writer.hpp"

namespace inslab::dds {
namespace {

using Message = std::vector<unsigned char>;
constexpr unsigned char kFastDds = 15;
constexpr unsigned char kStatistics = 0x80;
constexpr unsigned char kHeartbeat = 0x07;

Message header(unsigned char vendor = kFastDds) {
  Message message{'R', 'T', 'P', 'S', 2, 3, 1, vendor};
  message.resize(20, 0x66);
  return message;
}

/// With `length` bytes in it and that length in its head, in either order of bytes.
Message& add(Message& message, unsigned char kind, std::size_t length, bool little_endian = true) {
  const auto low = static_cast<unsigned char>(length);
  const auto high = static_cast<unsigned char>(length >> 8);
  message.insert(message.end(), {kind, static_cast<unsigned char>(little_endian ? 1 : 0), little_endian ? low : high,
                                 little_endian ? high : low});
  message.resize(message.size() + length);
  return message;
}

bool harmless(const Message& message) { return is_harmless(message.data(), message.size()); }

/// What any participant of Fast DDS 2.9.1 dies of.
Message lethal() {
  Message message = header();
  add(message, kStatistics, 56).push_back(0);
  return message;
}

TEST(PacketGuard, LetsWhatFastDdsItselfSendsPass) {
  Message message = header();
  add(message, kHeartbeat, 28);
  EXPECT_TRUE(harmless(message));
  add(message, kStatistics, 56);
  EXPECT_TRUE(harmless(message));
}

TEST(PacketGuard, StopsStatisticsThatAreNotTheLast) {
  EXPECT_FALSE(harmless(lethal()));
  for (const bool little_endian : {true, false}) {
    Message message = header();
    add(message, kHeartbeat, 28, little_endian);
    add(message, kStatistics, 56, little_endian);
    add(message, kHeartbeat, 28, little_endian);
    EXPECT_FALSE(harmless(message)) << little_endian;
  }
}

TEST(PacketGuard, LetsOtherVendorsSubmessagesPass) {
  constexpr unsigned char kCyclone = 16;
  Message message = header(kCyclone);
  add(message, kStatistics, 56).push_back(0);
  EXPECT_TRUE(harmless(message));
}

TEST(PacketGuard, ReadsNothingBeyondAMessageThatIsCutAnywhere) {
  Message whole = header();
  add(whole, kHeartbeat, 29);
  whole.resize(whole.size() + 3);
  add(whole, kStatistics, 56);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const Message cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_TRUE(harmless(cut)) << size;
  }
}

template <class Condition>
bool eventually(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

void send_to_every_port(const Message& message, std::uint32_t domain) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  ASSERT_GE(socket, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
  for (std::uint32_t port = 7400; port < 7430; ++port) {
    to.sin_port = htons(static_cast<std::uint16_t>(port + 250 * domain));
    sendto(socket, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof(to));
  }
  close(socket);
}

/// An assertion that fails would end this test's process.
class AParticipant : public testing::TestWithParam<Transport> {};

TEST_P(AParticipant, OutlivesADatagramThatEndsOthers) {
  ParticipantOptions options;
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  options.transport = GetParam();
  if (options.transport == Transport::Default) options.interface_address = "";
  Participant from(options);
  Participant to(options);
  std::atomic<int> came{0};
  const Reader<TruthState> reader(to, topics::truth(), [&came](const TruthState&, const SampleOrigin&) { ++came; });
  Writer<TruthState> writer(from, topics::truth());
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1 && reader.matched_writers() == 1; }));
  for (int i = 1; i <= 5; ++i) {
    send_to_every_port(lethal(), options.domain);
    ASSERT_TRUE(writer.write({}));
    ASSERT_TRUE(eventually([&] { return came.load() == i; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, AParticipant, testing::Values(Transport::Udp, Transport::Shm, Transport::Default));

TEST(SharedMemory, ThatIsTooSmallIsSaidBeforeAnythingRunsShortOfIt) {
  EXPECT_EQ(shared_memory_shortage(0), "");
  const std::string shortage = shared_memory_shortage(1'000'000);
  EXPECT_EQ(shortage.rfind("/dev/shm has ", 0), 0u) << shortage;
  EXPECT_NE(shortage.find("1000000 participants need "), std::string::npos) << shortage;
  EXPECT_NE(shortage.find("--transport udp"), std::string::npos) << shortage;
}

}  // namespace
}  // namespace inslab::dds
