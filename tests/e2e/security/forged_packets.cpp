#include "tests/e2e/security/forged_packets.hpp"

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace inslab::e2e {

namespace {

constexpr std::uint32_t kPortBase = 7400, kPortsOfADomain = 250, kUnicastOffset = 10;
constexpr std::uint32_t kParticipants = 12;
/// Fast DDS counts its endpoints from 1; no service of ours has more.
constexpr std::uint8_t kEndpoints = 40;
constexpr std::uint8_t kKeyedWriter = 0x02, kWriter = 0x03, kReader = 0x04, kKeyedReader = 0x07;
constexpr std::uint32_t kFarAway = 1'000'000;

sockaddr_in loopback(std::uint32_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

void add(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
void add_u32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}
void add_sequence_number(Bytes& bytes, std::uint32_t value) {
  add_u32(bytes, 0);
  add_u32(bytes, value);
}
Bytes entity(std::uint8_t key, std::uint8_t kind) { return {0, 0, key, kind}; }
const Bytes kAnyEntity{0, 0, 0, 0};

template <class Body>
Bytes for_each_writer(const GuidPrefix& prefix, std::uint8_t id, std::uint8_t flags, const Body& body) {
  Bytes datagram = header_of(prefix);
  for (std::uint8_t key = 1; key <= kEndpoints; ++key) {
    for (const std::uint8_t kind : {kKeyedWriter, kWriter}) append(datagram, id, flags, body(entity(key, kind)));
  }
  return datagram;
}

}  // namespace

Forger::Forger(std::uint32_t domain)
    : domain_(domain),
      sender_(socket(AF_INET, SOCK_DGRAM, 0)),
      listener_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
  const int yes = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address = loopback(kPortBase + kPortsOfADomain * domain_);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  ip_mreq group{};
  group.imr_multiaddr.s_addr = inet_addr("239.255.0.1");
  group.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      setsockopt(listener_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0) {
    throw std::runtime_error("the port of announcements cannot be listened to");
  }
}

Forger::~Forger() {
  close(sender_);
  close(listener_);
}

void Forger::listen() {
  Bytes buffer(65536);
  for (;;) {
    const ssize_t size = recv(listener_, buffer.data(), buffer.size(), 0);
    if (size < 0) return;
    if (size < 20 || !std::equal(buffer.begin(), buffer.begin() + 4, "RTPS")) continue;
    announcements_.emplace_back(buffer.begin(), buffer.begin() + size);
    GuidPrefix prefix{};
    std::copy_n(buffer.begin() + 8, prefix.size(), prefix.begin());
    participants_.insert(prefix);
  }
}

void Forger::send_to_all(const Bytes& datagram) {
  for (std::uint32_t port = 0; port < 2 * kParticipants; ++port) {
    const sockaddr_in to = loopback(kPortBase + kPortsOfADomain * domain_ + kUnicastOffset + port);
    // A port where nobody listens refuses a later datagram: that is no fault.
    if (sendto(sender_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) > 0) {
      ++sent_;
    }
  }
}

Sniffer::Sniffer(std::uint32_t domain)
    : domain_(domain), socket_(socket(AF_PACKET, SOCK_DGRAM | SOCK_NONBLOCK, htons(ETH_P_IP))) {
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_IP);
  address.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  if (socket_ >= 0) bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

Sniffer::~Sniffer() {
  if (socket_ >= 0) close(socket_);
}

void Sniffer::listen(std::size_t most) {
  constexpr std::size_t kIpAndUdpHeader = 28;
  Bytes buffer(65536);
  while (datagrams_.size() < most) {
    const ssize_t size = recv(socket_, buffer.data(), buffer.size(), 0);
    if (size < 0) return;
    if (size < static_cast<ssize_t>(kIpAndUdpHeader + 20) || buffer[9] != IPPROTO_UDP) continue;
    const std::uint32_t port = std::uint32_t{buffer[22]} << 8 | buffer[23];
    const std::uint32_t first = kPortBase + kPortsOfADomain * domain_;
    if (port < first || port >= first + kPortsOfADomain) continue;
    datagrams_.emplace_back(buffer.begin() + kIpAndUdpHeader, buffer.begin() + size);
  }
}

Bytes header_of(const GuidPrefix& prefix) {
  Bytes datagram{'R', 'T', 'P', 'S', 2, 3, 1, 15};
  datagram.insert(datagram.end(), prefix.begin(), prefix.end());
  return datagram;
}

void append(Bytes& datagram, std::uint8_t id, std::uint8_t flags, const Bytes& body) {
  const auto size = static_cast<std::uint16_t>(body.size());
  add(datagram, {id, static_cast<std::uint8_t>(flags | 1), static_cast<std::uint8_t>(size),
                 static_cast<std::uint8_t>(size >> 8)});
  add(datagram, body);
}

Bytes forged_heartbeats(const GuidPrefix& prefix) {
  return for_each_writer(prefix, 0x07, 0, [](const Bytes& writer) {
    Bytes body = kAnyEntity;
    add(body, writer);
    add_sequence_number(body, kFarAway);
    add_sequence_number(body, kFarAway - 1);
    add_u32(body, 0x7fffffff);
    return body;
  });
}

Bytes forged_gaps(const GuidPrefix& prefix) {
  return for_each_writer(prefix, 0x08, 0, [](const Bytes& writer) {
    Bytes body = kAnyEntity;
    add(body, writer);
    add_sequence_number(body, 1);
    add_sequence_number(body, kFarAway);
    add_u32(body, 0);
    return body;
  });
}

Bytes forged_acknowledgements(const GuidPrefix& prefix, std::uint8_t writer_key) {
  Bytes datagram = header_of(prefix);
  for (std::uint8_t key = 1; key <= kEndpoints; ++key) {
    for (const std::uint8_t reader : {kReader, kKeyedReader}) {
      for (const std::uint8_t writer : {kKeyedWriter, kWriter}) {
        Bytes body = entity(key, reader);
        add(body, entity(writer_key, writer));
        add_sequence_number(body, 200);
        add_u32(body, 0);
        add_u32(body, 0x7fffffff);
        append(datagram, 0x06, 2, body);
      }
    }
  }
  return datagram;
}

Bytes forged_data(const GuidPrefix& prefix) {
  return for_each_writer(prefix, 0x15, 4, [](const Bytes& writer) {
    Bytes body{0, 0, 16, 0};
    add(body, kAnyEntity);
    add(body, writer);
    add_sequence_number(body, 300);
    add(body, {0, 1, 0, 0});
    body.resize(body.size() + 196, 0x42);
    return body;
  });
}

Bytes forged_farewell(const GuidPrefix& prefix) {
  Bytes datagram = header_of(prefix);
  Bytes guid(prefix.begin(), prefix.end());
  add(guid, {0, 0, 1, 0xc1});
  Bytes body{0, 0, 16, 0, 0, 1, 0, 0xc7, 0, 1, 0, 0xc2};
  add_sequence_number(body, 900);
  add(body, {0x70, 0, 16, 0});  // the key
  add(body, guid);
  add(body, {0x71, 0, 4, 0, 0, 0, 0, 3});  // disposed of, unregistered
  add(body, {1, 0, 0, 0});
  append(datagram, 0x15, 2, body);
  return datagram;
}

Bytes fatal_datagram() {
  Bytes datagram = header_of({1, 15, 0x66, 0x66, 0x66, 0x66, 0x66, 0x66, 0x66, 0x66, 0x66, 0x66});
  append(datagram, 0x80, 0, Bytes(56));
  datagram.push_back(0);
  return datagram;
}

}  // namespace inslab::e2e
