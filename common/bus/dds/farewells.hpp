#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace inslab::dds {

/// Farewells in the clear, of which nobody knows who sent them: a participant of a secured set that leaves says so in
/// the clear, and whoever reaches the network can say it in its name. None is obeyed. One that was forged is known by
/// the participant that goes on speaking. May be used by several threads.
class Farewells {
 public:
  using GuidPrefix = std::array<std::uint8_t, 12>;
  using Time = std::chrono::steady_clock::time_point;

  /// A farewell in the name of `participant` came, from an address. False when there are more than a set can have.
  bool came(const GuidPrefix& participant, const std::string& from, Time now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto it = waiting_.begin(); it != waiting_.end();) {
      it = now - it->second.at > kUntilItIsGone ? waiting_.erase(it) : std::next(it);
    }
    if (waiting_.size() >= kMost && waiting_.count(participant) == 0) return false;
    waiting_.try_emplace(participant, Farewell{from, now});
    any_ = true;
    return true;
  }

  /// A datagram of `participant` came. Where a farewell in its name was forged, the address that came from, once.
  std::optional<std::string> belied_by(const GuidPrefix& participant, Time now) {
    if (!any_) return std::nullopt;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = waiting_.find(participant);
    if (found == waiting_.end() || now - found->second.at < kStillOnTheWay) return std::nullopt;
    std::optional<std::string> from(std::move(found->second.from));
    waiting_.erase(found);
    any_ = !waiting_.empty();
    return from;
  }

 private:
  /// A process that takes down its participant has three seconds for it (foundation/host/last_word.hpp), and what it
  /// has sent before may come by another way.
  static constexpr std::chrono::seconds kStillOnTheWay{4};
  static constexpr std::chrono::seconds kUntilItIsGone{60};
  static constexpr std::size_t kMost = 1024;

  struct Farewell {
    std::string from;
    Time at;
  };

  std::mutex mutex_;
  std::map<GuidPrefix, Farewell> waiting_;
  std::atomic<bool> any_{false};
};

}  // namespace inslab::dds
