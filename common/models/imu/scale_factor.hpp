#pragma once

#include "inslab/models/imu/axes.hpp"
#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/noise/random/gauss_markov.hpp"
#include "inslab/noise/random/random_constant.hpp"

namespace inslab::imu {

/// Stage 3a: each axis reads its own input too large by its scale factor error, S in thesis (3-35), (3-36): a constant,
/// one drawn once a run, a first-order Gauss-Markov process held over each sample, and a part by temperature.
class ScaleFactor {
 public:
  /// `triad` is the root of the stream names, such as "imu0/gyro". Throws std::invalid_argument as the processes do.
  ScaleFactor(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad)
      : turn_on_(per_axis(triad,
                          [&](int axis, const std::string& root) {
                            return random::RandomConstant(parameters.scale_factor_turn_on_sigma[axis],
                                                          random::Stream(seed, root + "scale_factor_turn_on"));
                          })),
        gauss_markov_(per_axis(triad, [&](int axis, const std::string& root) {
          return random::GaussMarkov(
              {parameters.scale_factor_gm_sigma[axis], parameters.scale_factor_gm_correlation_time_s[axis]}, dt_s,
              random::Stream(seed, root + "scale_factor_gm"));
        })) {
    take(parameters);
  }

  /// Takes new parameters between intervals `k` - 1 and `k`; continuity as in Bias::retune.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    for (int axis = 0; axis < 3; ++axis) {
      turn_on_[axis].retune(parameters.scale_factor_turn_on_sigma[axis]);
      gauss_markov_[axis].retune(
          {parameters.scale_factor_gm_sigma[axis], parameters.scale_factor_gm_correlation_time_s[axis]});
      if (continuity == Continuity::Reset) gauss_markov_[axis].reset();
      if (continuity == Continuity::Redraw) {
        gauss_markov_[axis].redraw(k);
        turn_on_[axis].redraw(k);
      }
    }
    take(parameters);
  }

  /// The error of the increment of interval `k`, in its unit; `warmer_k` is the temperature above that of calibration.
  /// Intervals come in order: the Gauss-Markov states advance.
  Vector3 error(const Vector3& sensed, double warmer_k, std::uint64_t k) {
    Vector3 scale_factor = constant_ + warmer_k * per_deg_c_;
    if (varies_) {
      for (int axis = 0; axis < 3; ++axis) {
        scale_factor[axis] += gauss_markov_[axis].value();
        gauss_markov_[axis].advance(k);
      }
    }
    return scale_factor.cwiseProduct(sensed);
  }

  /// The same of any input at the interval that is next; nothing advances.
  Vector3 next_error(const Vector3& sensed, double warmer_k) const {
    Vector3 scale_factor = constant_ + warmer_k * per_deg_c_;
    if (varies_) {
      for (int axis = 0; axis < 3; ++axis) scale_factor[axis] += gauss_markov_[axis].value();
    }
    return scale_factor.cwiseProduct(sensed);
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.constant_, self.turn_on_, self.gauss_markov_);
  }

 private:
  void take(const TriadParameters& parameters) {
    constant_ = parameters.scale_factor;
    for (int axis = 0; axis < 3; ++axis) constant_[axis] += turn_on_[axis].value();
    per_deg_c_ = parameters.scale_factor_per_deg_c;
    varies_ = !parameters.scale_factor_gm_sigma.isZero(0.0);
  }

  Vector3 constant_;   ///< with what was drawn at turn-on
  Vector3 per_deg_c_;  ///< 1/K
  std::array<random::RandomConstant, 3> turn_on_;
  std::array<random::GaussMarkov, 3> gauss_markov_;
  bool varies_ = false;
};

}  // namespace inslab::imu
