#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "random/gauss_markov.hpp"
#include "random/random_constant.hpp"
#include "samples/profile_request.hpp"
#include "services/imu_error_injector/triad_parameters.hpp"

namespace inslab::imu {

/// The names of a triad's axes in stream names: "imu0/gyro" gives "imu0/gyro.x/".
inline std::array<std::string, 3> axis_names(const std::string& triad) {
  return {triad + ".x/", triad + ".y/", triad + ".z/"};
}

/// Stage 4a: bias of a triad: a constant, a turn-on value drawn once a run, a first-order Gauss-Markov process (held
/// over each sample), and a jump while a fault is on.
class Bias {
 public:
  /// `triad` is the root of the stream names, such as "imu0/gyro". Throws std::invalid_argument as the processes do.
  Bias(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad)
      : Bias(parameters, dt_s, seed, axis_names(triad)) {}

  /// Takes new parameters between intervals `k` - 1 and `k`. Keep: random states keep their size in units of sigma.
  /// Reset: Gauss-Markov states start from 0. Redraw: they and the turn-on values are drawn anew.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    constant_ = parameters.bias_constant;
    for (int axis = 0; axis < 3; ++axis) {
      turn_on_[axis].retune(parameters.bias_turn_on_sigma[axis]);
      gauss_markov_[axis].retune({parameters.bias_gm_sigma[axis], parameters.bias_gm_correlation_time_s[axis]});
      if (continuity == Continuity::Reset) gauss_markov_[axis].reset();
      if (continuity == Continuity::Redraw) {
        gauss_markov_[axis].redraw(k);
        turn_on_[axis].redraw(k);
      }
    }
  }

  /// Bias added by a fault, rad/s | m/s^2; zero ends it.
  void set_jump(const Vector3& jump) { jump_ = jump; }

  /// The error of interval `k`, rad | m/s. Intervals come in order: the Gauss-Markov states advance.
  Vector3 error(std::uint64_t k) {
    Vector3 bias = constant_ + jump_;
    for (int axis = 0; axis < 3; ++axis) {
      bias[axis] += turn_on_[axis].value() + gauss_markov_[axis].value();
      gauss_markov_[axis].advance(k);
    }
    return bias * dt_s_;
  }

 private:
  Bias(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::array<std::string, 3>& axes)
      : dt_s_(dt_s),
        constant_(parameters.bias_constant),
        turn_on_{turn_on(parameters, seed, axes, 0), turn_on(parameters, seed, axes, 1),
                 turn_on(parameters, seed, axes, 2)},
        gauss_markov_{gauss_markov(parameters, dt_s, seed, axes, 0), gauss_markov(parameters, dt_s, seed, axes, 1),
                      gauss_markov(parameters, dt_s, seed, axes, 2)} {}

  static random::RandomConstant turn_on(const TriadParameters& parameters, std::uint64_t seed,
                                        const std::array<std::string, 3>& axes, int axis) {
    return {parameters.bias_turn_on_sigma[axis], random::Stream(seed, axes[axis] + "bias_turn_on")};
  }
  static random::GaussMarkov gauss_markov(const TriadParameters& parameters, double dt_s, std::uint64_t seed,
                                          const std::array<std::string, 3>& axes, int axis) {
    return {{parameters.bias_gm_sigma[axis], parameters.bias_gm_correlation_time_s[axis]},
            dt_s,
            random::Stream(seed, axes[axis] + "bias_gm")};
  }

  double dt_s_;
  Vector3 constant_;
  Vector3 jump_ = Vector3::Zero();
  std::array<random::RandomConstant, 3> turn_on_;
  std::array<random::GaussMarkov, 3> gauss_markov_;
};

}  // namespace inslab::imu
