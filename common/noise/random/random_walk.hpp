#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// Random walk sampled every `dt`, from 0 on.
///
///   x[k+1] = x[k] + w[k],   w ~ N(0, K^2 dt),   x[0] = 0
///
/// `density` K is in the unit of the quantity per square root of a second. Number k of the stream draws w[k].
/// Source: thesis (2-60), (2-61).
class RandomWalk {
 public:
  /// Throws std::invalid_argument unless density >= 0 and dt_s > 0, both finite.
  RandomWalk(double density, double dt_s, Stream stream) : numbers_(stream) {
    if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("random walk: the interval is not above 0 s");
    sqrt_dt_ = std::sqrt(dt_s);
    retune(density);
  }

  /// x at the present sample.
  double value() const { return density_ * x_over_density_; }

  /// Goes from sample k to sample k + 1. The step depends on (stream, k) alone; while the density is 0 it rests and
  /// nothing is drawn.
  void advance(std::uint64_t k) {
    if (density_ != 0.0) x_over_density_ += sqrt_dt_ * numbers_.at(k);
  }

  /// Takes a new density between two samples; the state keeps its size in units of it, as that of every other process
  /// does. Throws as the constructor does and then changes nothing.
  void retune(double density) {
    if (!(std::isfinite(density) && density >= 0.0)) throw std::invalid_argument("random walk: the density is below 0");
    density_ = density;
  }

  /// The walk begins at 0 again.
  void reset() { x_over_density_ = 0.0; }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.x_over_density_);
  }

 private:
  double sqrt_dt_ = 0.0;
  double density_ = 0.0;
  NormalCursor numbers_;
  double x_over_density_ = 0.0;  ///< sqrt(s)
};

}  // namespace inslab::random
