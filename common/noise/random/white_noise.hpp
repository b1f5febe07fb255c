#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// White noise integrated over a sample interval: a rate (or force) noise of density N gives increments
/// w[k] ~ N(0, N^2 dt), independent of each other: the angle (velocity) random walk.
///
/// `density` is in the unit of the increment per square root of a second. Source: thesis (2-58), math of 4.4.2 (1).
class WhiteNoise {
 public:
  /// Throws std::invalid_argument unless density >= 0 and dt_s > 0, both finite.
  WhiteNoise(double density, double dt_s, Stream stream) : dt_s_(dt_s), numbers_(stream) {
    if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("white noise: the interval is not above 0 s");
    retune(density);
  }

  /// Takes a new density between two samples. Throws as the constructor does and then changes nothing.
  void retune(double density) {
    if (!(std::isfinite(density) && density >= 0.0)) throw std::invalid_argument("white noise: the density is below 0");
    sigma_ = density * std::sqrt(dt_s_);
  }

  /// The increment of interval `k`. Depends on (stream, k) alone.
  double increment(std::uint64_t k) { return sigma_ == 0.0 ? 0.0 : sigma_ * numbers_.at(k); }

 private:
  double dt_s_;
  double sigma_ = 0.0;
  NormalCursor numbers_;
};

}  // namespace inslab::random
