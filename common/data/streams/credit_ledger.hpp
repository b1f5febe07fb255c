#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/data/samples/credit.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::streams {

/// Who consumes a lockstep topic.
using ConsumerKey = std::pair<std::string, std::uint32_t>;  // service, number

/// The producer's record of a lockstep topic's consumers: how far each has come. Those known from the start count as
/// wanting sample 0 until they say otherwise; another one counts from its first credit on, and as long as it comes on.
/// Knows no bus and no clock.
class CreditLedger {
 public:
  /// How long one that nobody expected may hold up the others without coming on.
  static constexpr time::Nanoseconds kPatience = std::chrono::seconds(5);
  /// Of those that nobody expected.
  static constexpr std::size_t kMostConsumers = 64;

  CreditLedger(std::string topic, const std::vector<ConsumerKey>& expected) : topic_(std::move(topic)) {
    for (const ConsumerKey& consumer : expected) consumers_[consumer].is_expected = true;
  }

  /// Takes a credit that came at `now`; those of other topics and runs are not ours. True when it was taken.
  bool take(const Credit& credit, const RunId& run, time::Nanoseconds now) {
    if (credit.topic != topic_ || credit.run_id != run) return false;
    const ConsumerKey key{credit.consumer, credit.consumer_number};
    const bool is_new = consumers_.count(key) == 0;
    if (is_new && consumers_.size() >= kMostConsumers) return false;
    Consumer& consumer = consumers_[key];
    consumer.next_wanted = credit.next_sequence;
    if (is_new || credit.next_sequence > consumer.furthest) {
      consumer.furthest = credit.next_sequence;
      consumer.came_on_at = now;
      consumer.is_left_behind = false;
    }
    return true;
  }

  /// From now on nobody waits for those that were not expected, lack samples before `end`, and have not come on for
  /// kPatience: until they do. Their names; empty when there is none.
  std::string leave_behind(std::uint64_t end, time::Nanoseconds now) {
    std::string names;
    for (auto& [key, consumer] : consumers_) {
      const bool stands = consumer.next_wanted < end && now - consumer.came_on_at > kPatience;
      if (consumer.is_expected || consumer.is_left_behind || !stands) continue;
      consumer.is_left_behind = true;
      append(names, key);
    }
    return names;
  }

  /// The least sample that some consumer still wants; nothing when there is no consumer.
  std::optional<std::uint64_t> lowest() const {
    std::optional<std::uint64_t> lowest;
    for (const auto& [key, consumer] : consumers_) {
      if (!consumer.is_left_behind && (!lowest || consumer.next_wanted < *lowest)) lowest = consumer.next_wanted;
    }
    return lowest;
  }

  /// Whether this consumer has said that it has everything before `sequence`.
  bool has_all_before(std::uint64_t sequence, const ConsumerKey& consumer) const {
    const auto found = consumers_.find(consumer);
    return found != consumers_.end() && found->second.next_wanted >= sequence;
  }

  /// Who still wants the least sample, for messages.
  std::string slowest() const {
    std::string names;
    const auto least = lowest();
    for (const auto& [key, consumer] : consumers_) {
      if (consumer.next_wanted == least) append(names, key);
    }
    return names;
  }

 private:
  struct Consumer {
    std::uint64_t next_wanted = 0;
    std::uint64_t furthest = 0;
    time::Nanoseconds came_on_at{0};
    bool is_expected = false;
    bool is_left_behind = false;
  };

  static void append(std::string& names, const ConsumerKey& key) {
    names += (names.empty() ? "" : ", ") + key.first + " " + std::to_string(key.second);
  }

  std::string topic_;
  std::map<ConsumerKey, Consumer> consumers_;
};

}  // namespace inslab::streams
