#pragma once

#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/models/sensing/read_out.hpp"
#include "inslab/noise/random/scalar_noise.hpp"

namespace inslab::air_data {

/// A pressure sensor: counts(range((1 + scale) p + offset + white + Gauss-Markov)).
class PressureSensor {
 public:
  PressureSensor(const random::Stream& stream, double period_s) : noise_(stream, period_s) {}

  void use(const PressureSensorErrors& errors) {
    errors_ = errors;
    noise_.retune(errors.white_sigma_pa, errors.gm_sigma_pa, errors.gm_correlation_time_s);
  }
  void go_on(Continuity continuity, std::uint64_t k) { sensing::go_on(continuity, k, noise_); }

  /// What it shows at sample k, Pa, entered into the budget; `saturated` is set where that is an end of the range.
  double shown_pa(std::uint64_t k, double pressure_pa, PressureErrorBudget& budget, bool& saturated) {
    budget.instrument = units::kPpm * errors_.scale_factor_ppm * pressure_pa + errors_.offset_pa;
    budget.noise = noise_.advance(k);
    const double sensed_pa = pressure_pa + budget.instrument + budget.noise;
    double shown_pa = sensed_pa;
    const bool has_range = errors_.min_pressure_pa != 0.0 || errors_.max_pressure_pa != 0.0;
    if (has_range && sensing::cut(shown_pa, errors_.min_pressure_pa, errors_.max_pressure_pa)) saturated = true;
    shown_pa = sensing::quantized(shown_pa, errors_.quantization_pa);
    budget.limits = shown_pa - sensed_pa;
    return shown_pa;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.noise_);
  }

 private:
  PressureSensorErrors errors_;
  random::ScalarNoise noise_;
};

}  // namespace inslab::air_data
