#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "inslab/data/samples/block.hpp"

namespace inslab::streams {

/// The newest samples a producer has sent, as many as somebody may still ask for again. Knows no bus.
template <class Sample>
class SentWindow {
 public:
  /// Keeps at most `capacity` samples.
  explicit SentWindow(std::size_t capacity) : capacity_(capacity) {}

  /// The samples of one stream, in order.
  void add(const Sample& sample) {
    if (samples_.size() == capacity_) samples_.pop_front();
    samples_.push_back(sample);
  }

  /// Forgets what lies before `sequence`.
  void forget_before(std::uint64_t sequence) {
    while (!samples_.empty() && samples_.front().header.sequence_number < sequence) samples_.pop_front();
  }

  /// Sequence number of the oldest sample kept; one past the newest when none is.
  std::uint64_t first() const { return samples_.empty() ? 0 : samples_.front().header.sequence_number; }
  bool empty() const { return samples_.empty(); }

  /// Up to `most` samples from `sequence` on, or from the oldest kept when that is newer.
  Block<Sample> from(std::uint64_t sequence, std::size_t most) const {
    Block<Sample> block;
    const auto begin = std::lower_bound(
        samples_.begin(), samples_.end(), sequence,
        [](const Sample& sample, std::uint64_t wanted) { return sample.header.sequence_number < wanted; });
    for (auto at = begin; at != samples_.end() && block.samples.size() < most; ++at) block.samples.push_back(*at);
    return block;
  }

 private:
  std::size_t capacity_;
  std::deque<Sample> samples_;
};

}  // namespace inslab::streams
