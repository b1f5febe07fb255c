#include "inslab/formats/log/sequence_check.hpp"

#include <iterator>

namespace inslab::log {

void SequenceCheck::add(std::uint64_t sequence_number, std::int64_t sim_time_ns) {
  if (sequence_number < next_) {
    fill(sequence_number);
    return;
  }
  if (sequence_number > next_) gaps_[next_] = {next_, sequence_number - 1, newest_sim_time_ns_};
  next_ = sequence_number + 1;
  newest_sim_time_ns_ = sim_time_ns;
}

void SequenceCheck::fill(std::uint64_t sequence_number) {
  auto at = gaps_.upper_bound(sequence_number);
  if (at == gaps_.begin() || std::prev(at)->second.last < sequence_number) {
    ++duplicates_;
    return;
  }
  ++out_of_order_;
  at = std::prev(at);
  const SequenceGap gap = at->second;
  gaps_.erase(at);
  if (gap.first < sequence_number) gaps_[gap.first] = {gap.first, sequence_number - 1, gap.after_sim_time_ns};
  if (gap.last > sequence_number) gaps_[sequence_number + 1] = {sequence_number + 1, gap.last, gap.after_sim_time_ns};
}

std::vector<SequenceGap> SequenceCheck::gaps() const {
  std::vector<SequenceGap> all;
  for (const auto& [first, gap] : gaps_) all.push_back(gap);
  return all;
}

std::uint64_t SequenceCheck::missing() const {
  std::uint64_t sum = 0;
  for (const auto& [first, gap] : gaps_) sum += gap.count();
  return sum;
}

}  // namespace inslab::log
