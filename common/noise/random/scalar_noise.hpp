#pragma once

#include <cstdint>

#include "inslab/noise/random/gauss_markov.hpp"

namespace inslab::random {

/// Errors of a quantity, in its unit: white noise and a first-order Gauss-Markov process, with the streams
/// "<root>/white" and "<root>/gm".
class ScalarNoise {
 public:
  /// Zero until retune(). Throws std::invalid_argument unless period_s is above 0.
  ScalarNoise(const Stream& root, double period_s)
      : white_(root.child("/white")), gauss_markov_({}, period_s, root.child("/gm")) {}

  /// Takes other sigmas between two samples; the Gauss-Markov state keeps its size in units of sigma. Throws
  /// std::invalid_argument as GaussMarkov does.
  void retune(double white_sigma, double gm_sigma, double gm_correlation_time_s) {
    white_sigma_ = white_sigma;
    gauss_markov_.retune({gm_sigma, gm_correlation_time_s});
  }

  /// The Gauss-Markov state goes to zero, or is drawn anew after sample `k`.
  void reset() { gauss_markov_.reset(); }
  void redraw(std::uint64_t k) { gauss_markov_.redraw(k); }

  /// The error of sample `k`, k >= 1. Samples come in order, each once: the Gauss-Markov state advances, from number 0
  /// of its stream at sample 0. The draws depend on (stream, k) alone.
  double advance(std::uint64_t k) { return white_sigma_ * white_.at(k) + gauss_markov_.advance(k - 1); }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.gauss_markov_);
  }

 private:
  NormalCursor white_;
  GaussMarkov gauss_markov_;
  double white_sigma_ = 0.0;
};

}  // namespace inslab::random
