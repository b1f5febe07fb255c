#pragma once

#include "random/white_noise.hpp"
#include "samples/imu_truth.hpp"
#include "services/imu_error_injector/bias.hpp"
#include "services/imu_error_injector/cross_axis.hpp"
#include "services/imu_error_injector/scale_factor.hpp"

namespace inslab::imu {

/// Stages 3 and 4 of one triad, term by term; what gyros and accelerometers share.
class TriadErrors {
 public:
  /// `triad` such as "imu0/gyro"; `walk` names the white noise's stream, "arw" or "vrw".
  TriadErrors(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad,
              const std::string& walk)
      : scale_factor_(parameters.scale_factor),
        cross_axis_(parameters.cross_axis_rad),
        bias_(parameters, dt_s, seed, triad),
        noise_{noise(parameters, dt_s, seed, triad, walk, 0), noise(parameters, dt_s, seed, triad, walk, 1),
               noise(parameters, dt_s, seed, triad, walk, 2)} {}

  /// Takes new parameters before interval `k`; see Bias::retune.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    scale_factor_ = ScaleFactor(parameters.scale_factor);
    cross_axis_ = CrossAxis(parameters.cross_axis_rad);
    bias_.retune(parameters, continuity, k);
    for (int axis = 0; axis < 3; ++axis) noise_[axis].retune(parameters.random_walk[axis]);
  }

  void set_bias_jump(const Vector3& jump) { bias_.set_jump(jump); }

  /// The errors of interval `k`. The triad senses its perfect increment and the vibration, and errs on both.
  TriadErrorBudget errors(const Vector3& perfect, const Vector3& vibration, std::uint64_t k) {
    const Vector3 sensed = perfect + vibration;
    TriadErrorBudget budget;
    budget.vibration = vibration;
    budget.scale = scale_factor_.error(sensed);
    budget.cross_axis = cross_axis_.error(sensed);
    budget.bias = bias_.error(k);
    for (int axis = 0; axis < 3; ++axis) budget.noise[axis] = noise_[axis].increment(k);
    return budget;
  }

 private:
  static random::WhiteNoise noise(const TriadParameters& parameters, double dt_s, std::uint64_t seed,
                                  const std::string& triad, const std::string& walk, int axis) {
    return {parameters.random_walk[axis], dt_s, random::Stream(seed, axis_names(triad)[axis] + walk)};
  }

  ScaleFactor scale_factor_;
  CrossAxis cross_axis_;
  Bias bias_;
  std::array<random::WhiteNoise, 3> noise_;
};

}  // namespace inslab::imu
