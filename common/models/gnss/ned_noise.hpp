#pragma once

#include <array>
#include <cstdint>

#include "inslab/data/requests/profile_request.hpp"
#include "inslab/noise/random/gauss_markov.hpp"

namespace inslab::gnss {

/// Errors of one quantity north, east and down: white noise and a first-order Gauss-Markov process each, in the
/// quantity's unit. Every axis and term has its stream, named after `root`: "gnss0/position.north/white".
class NedNoise {
 public:
  /// Zero until retune(). Throws std::invalid_argument unless period_s is above 0.
  NedNoise(const random::Stream& root, double period_s)
      : white_{random::NormalCursor(root.child(".north/white")), random::NormalCursor(root.child(".east/white")),
               random::NormalCursor(root.child(".down/white"))},
        gauss_markov_{random::GaussMarkov({}, period_s, root.child(".north/gm")),
                      random::GaussMarkov({}, period_s, root.child(".east/gm")),
                      random::GaussMarkov({}, period_s, root.child(".down/gm"))} {}

  /// Takes other sigmas between two epochs; Gauss-Markov states keep their size in units of sigma. Throws
  /// std::invalid_argument as random::GaussMarkov does.
  void retune(const Vector3& white_sigma, const Vector3& gm_sigma, const Vector3& gm_correlation_time_s) {
    white_sigma_ = white_sigma;
    for (int axis = 0; axis < 3; ++axis) gauss_markov_[axis].retune({gm_sigma[axis], gm_correlation_time_s[axis]});
  }

  /// What a swap does to the Gauss-Markov states after epoch `k`.
  void restart(Continuity continuity, std::uint64_t k) {
    for (random::GaussMarkov& process : gauss_markov_) {
      if (continuity == Continuity::Reset) process.reset();
      if (continuity == Continuity::Redraw) process.redraw(k);
    }
  }

  /// The error of epoch `k`, k >= 1. Epochs come in order, each once: the Gauss-Markov states advance, from number 0 of
  /// their streams at epoch 0. The draws depend on (stream, k) alone.
  Vector3 advance(std::uint64_t k) {
    Vector3 error;
    for (int axis = 0; axis < 3; ++axis) {
      error[axis] = white_sigma_[axis] * white_[axis].at(k) + gauss_markov_[axis].advance(k - 1);
    }
    return error;
  }

  /// What goes on from sample to sample (recovery/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.gauss_markov_);
  }

 private:
  std::array<random::NormalCursor, 3> white_;
  std::array<random::GaussMarkov, 3> gauss_markov_;
  Vector3 white_sigma_ = Vector3::Zero();
};

}  // namespace inslab::gnss
