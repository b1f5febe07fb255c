#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "samples/credit.hpp"

namespace inslab::app {

/// Who consumes a lockstep topic.
using ConsumerKey = std::pair<std::string, std::uint32_t>;  // service, number

/// The producer's record of a lockstep topic's consumers: how far each has come. Those known from the start count as
/// wanting sample 0 until they say otherwise; another one counts from its first credit on. Knows no bus.
class CreditLedger {
 public:
  CreditLedger(std::string topic, const std::vector<ConsumerKey>& expected) : topic_(std::move(topic)) {
    for (const ConsumerKey& consumer : expected) next_wanted_[consumer] = 0;
  }

  /// Takes a credit; those of other topics and runs are not ours. True when it was taken.
  bool take(const Credit& credit, const RunId& run) {
    if (credit.topic != topic_ || credit.run_id != run) return false;
    next_wanted_[{credit.consumer, credit.consumer_number}] = credit.next_sequence;
    return true;
  }

  /// The least sample that some consumer still wants; nothing when there is no consumer.
  std::optional<std::uint64_t> lowest() const {
    std::optional<std::uint64_t> lowest;
    for (const auto& [consumer, next] : next_wanted_) {
      if (!lowest || next < *lowest) lowest = next;
    }
    return lowest;
  }

  /// Whether this consumer has said that it has everything before `sequence`.
  bool has_all_before(std::uint64_t sequence, const ConsumerKey& consumer) const {
    const auto found = next_wanted_.find(consumer);
    return found != next_wanted_.end() && found->second >= sequence;
  }

  /// Who still wants the least sample, for messages.
  std::string slowest() const {
    std::string names;
    const auto least = lowest();
    for (const auto& [consumer, next] : next_wanted_) {
      if (next != least) continue;
      names += (names.empty() ? "" : ", ") + consumer.first + " " + std::to_string(consumer.second);
    }
    return names;
  }

 private:
  std::string topic_;
  std::map<ConsumerKey, std::uint64_t> next_wanted_;
};

}  // namespace inslab::app
