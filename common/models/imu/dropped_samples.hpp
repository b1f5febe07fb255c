#pragma once

#include "inslab/noise/random/stream.hpp"

namespace inslab::imu {

/// Stage 5e: each sample is lost on the way with the same probability, independently of the others.
class DroppedSamples {
 public:
  explicit DroppedSamples(double probability, random::Stream stream) : stream_(stream), probability_(probability) {}

  void retune(double probability) { probability_ = probability; }

  /// Depends on the stream and `k` alone.
  bool dropped(std::uint64_t k) const { return probability_ > 0.0 && stream_.uniform(k) < probability_; }

 private:
  random::Stream stream_;
  double probability_;
};

}  // namespace inslab::imu
