#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace inslab::log {

/// Sequence numbers that never came.
struct SequenceGap {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::int64_t after_sim_time_ns = 0;  ///< of the sample before; 0 at the beginning

  std::uint64_t count() const { return last - first + 1; }
  friend bool operator==(const SequenceGap& a, const SequenceGap& b) {
    return a.first == b.first && a.last == b.last && a.after_sim_time_ns == b.after_sim_time_ns;
  }
};

/// Counts what is wrong with a stream whose samples are numbered from 0 without gaps.
class SequenceCheck {
 public:
  void add(std::uint64_t sequence_number, std::int64_t sim_time_ns);

  /// What is missing, in order.
  std::vector<SequenceGap> gaps() const;
  std::uint64_t missing() const;
  std::uint64_t duplicates() const { return duplicates_; }
  /// Samples that came after one with a higher number.
  std::uint64_t out_of_order() const { return out_of_order_; }

 private:
  void fill(std::uint64_t sequence_number);

  std::map<std::uint64_t, SequenceGap> gaps_;  ///< by first
  std::uint64_t next_ = 0;
  std::int64_t newest_sim_time_ns_ = 0;
  std::uint64_t duplicates_ = 0;
  std::uint64_t out_of_order_ = 0;
};

}  // namespace inslab::log
