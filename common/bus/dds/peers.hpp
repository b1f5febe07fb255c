#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace inslab::dds {

/// What the writers of one participant have in common: the first part of its GUID.
using ParticipantKey = std::array<std::uint8_t, 12>;

/// Another participant, as its announcement describes it.
struct Peer {
  ParticipantKey key{};
  std::string name;                     ///< empty: it has none
  std::string address;                  ///< IPv4, where it can be reached; empty when not by UDP
  std::vector<std::uint8_t> user_data;  ///< what it says of itself
};

/// What one that only looks on says of itself: its readers count for nobody (bus/dds/writer.hpp).
std::vector<std::uint8_t> onlooker_announcement();
bool looks_on(const Peer& peer);

/// "'name', GUID 01.0f.9a.3c..., at 192.168.1.7"
std::string words_of(const Peer& peer);

/// The participants that have been heard of and have not left. One that was killed is here until its lease ends. May be
/// used by several threads.
class Peers {
 public:
  void note(Peer peer) {
    const std::lock_guard<std::mutex> lock(mutex_);
    peers_[peer.key] = std::move(peer);
  }
  void forget(const ParticipantKey& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    peers_.erase(key);
  }

  std::vector<Peer> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Peer> all;
    for (const auto& [key, peer] : peers_) all.push_back(peer);
    return all;
  }
  std::optional<Peer> find(const ParticipantKey& key) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = peers_.find(key);
    return found == peers_.end() ? std::nullopt : std::optional<Peer>(found->second);
  }

 private:
  mutable std::mutex mutex_;
  std::map<ParticipantKey, Peer> peers_;
};

}  // namespace inslab::dds
