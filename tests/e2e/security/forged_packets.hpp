#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace inslab::e2e {

using Bytes = std::vector<std::uint8_t>;
/// What the endpoints of one participant have in common, in the clear at the head of each of its datagrams.
using GuidPrefix = std::array<std::uint8_t, 12>;

/// Sends datagrams to the set's ports on the loopback, with no keys and as any user may, and hears what the set
/// announces to everybody.
class Forger {
 public:
  explicit Forger(std::uint32_t domain);
  ~Forger();
  Forger(const Forger&) = delete;
  Forger& operator=(const Forger&) = delete;

  /// The participants that announced themselves since the last call, and the announcements.
  void listen();
  const std::set<GuidPrefix>& participants() const { return participants_; }
  const std::vector<Bytes>& announcements() const { return announcements_; }

  /// To every port that a participant of this domain may have, for discovery and for data.
  void send_to_all(const Bytes& datagram);
  std::size_t sent() const { return sent_; }

 private:
  std::uint32_t domain_;
  int sender_;
  int listener_;
  std::set<GuidPrefix> participants_;
  std::vector<Bytes> announcements_;
  std::size_t sent_ = 0;
};

/// Hears every datagram of a domain on the loopback, as only root may.
class Sniffer {
 public:
  explicit Sniffer(std::uint32_t domain);
  ~Sniffer();
  Sniffer(const Sniffer&) = delete;
  Sniffer& operator=(const Sniffer&) = delete;

  /// Whether this user may listen.
  bool listens() const { return socket_ >= 0; }
  /// Takes what came since the last call, up to `most` in all.
  void listen(std::size_t most);
  const std::vector<Bytes>& datagrams() const { return datagrams_; }

 private:
  std::uint32_t domain_;
  int socket_;
  std::vector<Bytes> datagrams_;
};

/// Head of a datagram in the name of a participant.
Bytes header_of(const GuidPrefix& prefix);
/// Appends a submessage in little endian.
void append(Bytes& datagram, std::uint8_t id, std::uint8_t flags, const Bytes& body);

/// Heartbeats of every writer that the participant may have: "all you wait for is gone, my next is a million further".
Bytes forged_heartbeats(const GuidPrefix& prefix);
/// The same with gaps.
Bytes forged_gaps(const GuidPrefix& prefix);
/// Acknowledgements of every reader of the participant to every writer: "I have all that you ever sent".
Bytes forged_acknowledgements(const GuidPrefix& prefix, std::uint8_t writer_key);
/// Samples of every writer, of 200 bytes that mean nothing.
Bytes forged_data(const GuidPrefix& prefix);
/// "This participant is gone."
Bytes forged_farewell(const GuidPrefix& prefix);
/// A datagram that ends a Fast DDS 2.9.1 that reads it.
Bytes fatal_datagram();

}  // namespace inslab::e2e
