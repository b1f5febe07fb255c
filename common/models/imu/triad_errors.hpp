#pragma once

#include <cmath>

#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/models/imu/bias.hpp"
#include "inslab/models/imu/cross_axis.hpp"
#include "inslab/models/imu/cross_axis_drift.hpp"
#include "inslab/models/imu/noise.hpp"
#include "inslab/models/imu/nonlinearity.hpp"
#include "inslab/models/imu/sample_interval.hpp"
#include "inslab/models/imu/scale_factor.hpp"

namespace inslab::imu {

/// Stages 3 and 4 of one triad, term by term; what gyros and accelerometers share.
class TriadErrors {
 public:
  /// `triad` such as "imu0/gyro"; `walk` names the white noise's stream, "arw" or "vrw".
  TriadErrors(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad,
              const std::string& walk)
      : scale_factor_(parameters, dt_s, seed, triad),
        nonlinearity_(parameters),
        cross_axis_(parameters.cross_axis_rad),
        cross_axis_drift_(parameters, dt_s, seed, triad),
        bias_(parameters, dt_s, seed, triad),
        noise_(parameters, dt_s, seed, triad, walk) {}

  /// Takes new parameters before interval `k`; see Bias::retune.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    scale_factor_.retune(parameters, continuity, k);
    nonlinearity_ = Nonlinearity(parameters);
    cross_axis_ = CrossAxis(parameters.cross_axis_rad);
    cross_axis_drift_.retune(parameters, continuity, k);
    bias_.retune(parameters, continuity, k);
    noise_.retune(parameters);
  }

  /// Bias (rad/s | m/s^2) and noise density (rad/sqrt(s) | m/s/sqrt(s)) that a fault adds.
  void set_fault(const Vector3& bias_jump, const Vector3& burst) {
    bias_.set_jump(bias_jump);
    noise_.set_burst(burst);
  }

  /// Sets the errors of an interval in `budget`, whose terms are zero. The triad senses its perfect increment and the
  /// vibration, and errs on both; `warmer_k` is the temperature above that of calibration.
  void add_errors(const Vector3& perfect, const Vector3& vibration, double warmer_k, const SampleInterval& interval,
                  TriadErrorBudget& budget) {
    const Vector3 sensed = perfect + vibration;
    budget.vibration = vibration;
    budget.scale = scale_factor_.error(sensed, warmer_k, interval.k);
    if (!nonlinearity_.is_off()) budget.scale += nonlinearity_.error(sensed, interval.dt_s);
    if (!cross_axis_.is_off()) budget.cross_axis = cross_axis_.error(sensed);
    if (!cross_axis_drift_.is_off()) {
      budget.cross_axis += cross_axis_drift_.next_error(sensed);
      cross_axis_drift_.advance(interval.k);
    }
    budget.bias = interval.stretch * bias_.error(warmer_k, interval.k);
    budget.noise = std::sqrt(interval.stretch) * noise_.error(interval.k);
  }

  /// An input with its linear errors, scale and cross-axis, as the interval that is next makes them.
  Vector3 sensed(const Vector3& input, double warmer_k) const {
    const Vector3 linear = input + scale_factor_.next_error(input, warmer_k) + cross_axis_.error(input);
    return cross_axis_drift_.is_off() ? linear : Vector3(linear + cross_axis_drift_.next_error(input));
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.scale_factor_, self.cross_axis_drift_, self.bias_);
  }

 private:
  ScaleFactor scale_factor_;
  Nonlinearity nonlinearity_;
  CrossAxis cross_axis_;
  CrossAxisDrift cross_axis_drift_;
  Bias bias_;
  Noise noise_;
};

}  // namespace inslab::imu
