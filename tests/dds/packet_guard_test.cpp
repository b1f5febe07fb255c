#include "inslab/bus/dds/packet_guard.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"

namespace inslab::dds {
namespace packet_guard_test {

using Message = std::vector<unsigned char>;

/// What any participant of Fast DDS 2.9.1 dies of: its own statistics, and one byte more.
Message lethal() {
  Message message{'R', 'T', 'P', 'S', 2, 3, 1, 15};
  message.resize(20, 0x66);
  message.insert(message.end(), {0x80, 1, 56, 0});
  message.resize(message.size() + 57);
  return message;
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
  ParticipantOptions options;
  EXPECT_EQ(shared_memory_shortage(options, 1'000'000), "") << "UDP alone takes none";
  for (const Transport transport : {Transport::Shm, Transport::Default}) {
    options.transport = transport;
    EXPECT_EQ(shared_memory_shortage(options, 0), "");
    const std::string shortage = shared_memory_shortage(options, 1'000'000);
    EXPECT_EQ(shortage.rfind("/dev/shm has ", 0), 0u) << shortage;
    EXPECT_NE(shortage.find("1000000 participants need "), std::string::npos) << shortage;
    EXPECT_NE(shortage.find("--transport udp"), std::string::npos) << shortage;
  }
}

}  // namespace packet_guard_test
}  // namespace inslab::dds
