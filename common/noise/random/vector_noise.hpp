#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "inslab/noise/random/gauss_markov.hpp"

namespace inslab::random {

/// Errors of a quantity of three components, in its unit: white noise and a first-order Gauss-Markov process each.
/// Every component and term has its stream, named after `root` and the component: "gnss0/position.north/white".
class VectorNoise {
 public:
  using Names = std::array<std::string_view, 3>;
  static constexpr Names kNed{"north", "east", "down"};
  static constexpr Names kAxes{"x", "y", "z"};

  /// Zero until retune(). Throws std::invalid_argument unless period_s is above 0.
  VectorNoise(const Stream& root, const Names& names, double period_s)
      : white_{NormalCursor(child(root, names[0], "white")), NormalCursor(child(root, names[1], "white")),
               NormalCursor(child(root, names[2], "white"))},
        gauss_markov_{GaussMarkov({}, period_s, child(root, names[0], "gm")),
                      GaussMarkov({}, period_s, child(root, names[1], "gm")),
                      GaussMarkov({}, period_s, child(root, names[2], "gm"))} {}

  /// Takes other sigmas between two samples; Gauss-Markov states keep their size in units of sigma. Throws
  /// std::invalid_argument as GaussMarkov does.
  void retune(const Eigen::Vector3d& white_sigma, const Eigen::Vector3d& gm_sigma,
              const Eigen::Vector3d& gm_correlation_time_s) {
    white_sigma_ = white_sigma;
    for (int i = 0; i < 3; ++i) gauss_markov_[i].retune({gm_sigma[i], gm_correlation_time_s[i]});
  }

  /// The Gauss-Markov states go to zero, or are drawn anew after sample `k`.
  void reset() {
    for (GaussMarkov& process : gauss_markov_) process.reset();
  }
  void redraw(std::uint64_t k) {
    for (GaussMarkov& process : gauss_markov_) process.redraw(k);
  }

  /// The error of sample `k`, k >= 1. Samples come in order, each once: the Gauss-Markov states advance, from number 0
  /// of their streams at sample 0. The draws depend on (stream, k) alone.
  Eigen::Vector3d advance(std::uint64_t k) {
    Eigen::Vector3d error;
    for (int i = 0; i < 3; ++i) {
      error[i] = white_sigma_[i] * white_[i].at(k) + gauss_markov_[i].advance(k - 1);
    }
    return error;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.gauss_markov_);
  }

 private:
  static Stream child(const Stream& root, std::string_view component, std::string_view term) {
    return root.child("." + std::string(component) + "/" + std::string(term));
  }

  std::array<NormalCursor, 3> white_;
  std::array<GaussMarkov, 3> gauss_markov_;
  Eigen::Vector3d white_sigma_ = Eigen::Vector3d::Zero();
};

}  // namespace inslab::random
