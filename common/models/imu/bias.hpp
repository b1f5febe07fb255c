#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "inslab/models/imu/axes.hpp"
#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/noise/random/flicker.hpp"
#include "inslab/noise/random/gauss_markov.hpp"
#include "inslab/noise/random/random_constant.hpp"
#include "inslab/noise/random/random_walk.hpp"

namespace inslab::imu {

/// Stage 4a: bias of a triad, a sum, held over each sample, of a constant, a turn-on value drawn once a run, a part by
/// temperature, a first-order Gauss-Markov process, a random walk, flicker, and a jump while a fault is on.
class Bias {
 public:
  /// `triad` is the root of the stream names, such as "imu0/gyro". Throws std::invalid_argument as the processes do.
  Bias(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad)
      : dt_s_(dt_s),
        turn_on_(per_axis(triad,
                          [&](int axis, const std::string& root) {
                            return random::RandomConstant(parameters.bias_turn_on_sigma[axis],
                                                          random::Stream(seed, root + "bias_turn_on"));
                          })),
        gauss_markov_(per_axis(triad,
                               [&](int axis, const std::string& root) {
                                 return random::GaussMarkov(
                                     {parameters.bias_gm_sigma[axis], parameters.bias_gm_correlation_time_s[axis]},
                                     dt_s, random::Stream(seed, root + "bias_gm"));
                               })),
        walk_(per_axis(triad,
                       [&](int axis, const std::string& root) {
                         return random::RandomWalk(parameters.bias_random_walk[axis], dt_s,
                                                   random::Stream(seed, root + "bias_random_walk"));
                       })),
        flicker_(per_axis(triad, [&](int axis, const std::string& root) {
          return random::Flicker(parameters.bias_instability[axis], dt_s,
                                 random::Stream(seed, root + "bias_instability"));
        })) {
    take(parameters);
  }

  /// Takes new parameters between intervals `k` - 1 and `k`. Keep: random states keep their size in units of sigma.
  /// Reset: Gauss-Markov and flicker states and the walk start from 0. Redraw: states and turn-on values are drawn
  /// anew; the walk starts from 0.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    for (int axis = 0; axis < 3; ++axis) {
      turn_on_[axis].retune(parameters.bias_turn_on_sigma[axis]);
      gauss_markov_[axis].retune({parameters.bias_gm_sigma[axis], parameters.bias_gm_correlation_time_s[axis]});
      walk_[axis].retune(parameters.bias_random_walk[axis]);
      flicker_[axis].retune(parameters.bias_instability[axis]);
      if (continuity != Continuity::Keep) walk_[axis].reset();
      if (continuity == Continuity::Reset) {
        gauss_markov_[axis].reset();
        flicker_[axis].reset();
      }
      if (continuity == Continuity::Redraw) {
        gauss_markov_[axis].redraw(k);
        flicker_[axis].redraw(k);
        turn_on_[axis].redraw(k);
      }
    }
    take(parameters);
  }

  /// Bias added by a fault, rad/s | m/s^2; zero ends it.
  void set_jump(const Vector3& jump) { jump_ = jump; }

  /// The error of interval `k`, rad | m/s; `warmer_k` is the temperature above that of calibration. Intervals come in
  /// order: the states advance.
  Vector3 error(double warmer_k, std::uint64_t k) {
    Vector3 bias = constant_ + jump_ + warmer_k * per_deg_c_;
    if (has_gauss_markov_) add(gauss_markov_, k, bias);
    if (has_walk_) add(walk_, k, bias);
    if (has_flicker_) add(flicker_, k, bias);
    return bias * dt_s_;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.constant_, self.turn_on_, self.gauss_markov_, self.walk_, self.flicker_);
  }

 private:
  void take(const TriadParameters& parameters) {
    constant_ = parameters.bias_constant;
    for (int axis = 0; axis < 3; ++axis) constant_[axis] += turn_on_[axis].value();
    per_deg_c_ = parameters.bias_per_deg_c;
    has_gauss_markov_ = !parameters.bias_gm_sigma.isZero(0.0);
    has_walk_ = !parameters.bias_random_walk.isZero(0.0);
    has_flicker_ = !parameters.bias_instability.isZero(0.0);
  }

  template <class Process>
  static void add(std::array<Process, 3>& processes, std::uint64_t k, Vector3& bias) {
    for (int axis = 0; axis < 3; ++axis) {
      bias[axis] += processes[axis].value();
      processes[axis].advance(k);
    }
  }

  double dt_s_;
  Vector3 constant_;  ///< with what was drawn at turn-on
  Vector3 jump_ = Vector3::Zero();
  Vector3 per_deg_c_;
  std::array<random::RandomConstant, 3> turn_on_;
  std::array<random::GaussMarkov, 3> gauss_markov_;
  std::array<random::RandomWalk, 3> walk_;
  std::array<random::Flicker, 3> flicker_;
  bool has_gauss_markov_ = false;
  bool has_walk_ = false;
  bool has_flicker_ = false;
};

}  // namespace inslab::imu
