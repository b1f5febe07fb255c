#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>

namespace inslab::dds {

/// Farewells in the clear, in a set with keys: Fast DDS says a participant's own so, and anybody could say one in its
/// name. None is obeyed. One is false when its participant is heard of long after it. Knows no network; may be used by
/// several threads.
class Farewells {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using GuidPrefix = std::array<std::uint8_t, 12>;  ///< of the participant that is said to leave

  /// What a participant sent before it left may wait so long in a socket's buffer on a busy host.
  static constexpr std::chrono::seconds kLastWords{3};
  /// A participant says every second that it is there.
  static constexpr std::chrono::seconds kRemembered{60};
  static constexpr std::size_t kMost = 256;

  /// Takes a farewell. False when there are too many to remember: so many participants do not leave within a minute.
  bool note(const GuidPrefix& who, Time now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto at = said_.begin(); at != said_.end();) at = now - at->second > kRemembered ? said_.erase(at) : ++at;
    if (said_.size() >= kMost && said_.count(who) == 0) return false;
    said_.emplace(who, now);
    any_.store(true);
    return true;
  }

  /// Whether what has just come from a participant shows that its farewell was false; each is told once.
  bool is_belied(const GuidPrefix& by, Time now) {
    if (!any_.load()) return false;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = said_.find(by);
    if (found == said_.end() || now - found->second < kLastWords) return false;
    said_.erase(found);
    any_.store(!said_.empty());
    return true;
  }

 private:
  std::mutex mutex_;
  std::map<GuidPrefix, Time> said_;  ///< and when, the first time
  std::atomic<bool> any_{false};
};

}  // namespace inslab::dds
