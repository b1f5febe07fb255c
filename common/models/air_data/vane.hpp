#pragma once

#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/models/sensing/read_out.hpp"
#include "inslab/noise/random/scalar_noise.hpp"

namespace inslab::air_data {

/// A vane that turns into the flow: counts(range((1 + scale) (1 + upwash) angle + bias + white + Gauss-Markov)). One
/// that is frozen keeps its angle; its encoder goes on.
class Vane {
 public:
  Vane(const random::Stream& stream, double period_s) : noise_(stream, period_s) {}

  void use(const VaneErrors& errors) {
    errors_ = errors;
    noise_.retune(units::kDeg * errors.white_sigma_deg, units::kDeg * errors.gm_sigma_deg,
                  errors.gm_correlation_time_s);
  }
  void go_on(Continuity continuity, std::uint64_t k) { sensing::go_on(continuity, k, noise_); }

  /// What it shows at sample k, rad, entered into the budget; `saturated` is set where that is an end of the range.
  double shown_rad(std::uint64_t k, double angle_rad, bool is_frozen, FlowAngleErrorBudget& budget, bool& saturated) {
    if (!is_frozen) {
      turned_rad_ = (1.0 + units::kPpm * errors_.scale_factor_ppm) * (1.0 + errors_.upwash) * angle_rad +
                    units::kDeg * errors_.bias_deg;
    }
    budget.vane = turned_rad_ - angle_rad;
    budget.noise = noise_.advance(k);
    const double sensed_rad = turned_rad_ + budget.noise;
    double shown_rad = sensed_rad;
    const double full_scale_rad = units::kDeg * errors_.full_scale_deg;
    if (full_scale_rad > 0.0 && sensing::cut(shown_rad, -full_scale_rad, full_scale_rad)) saturated = true;
    shown_rad = sensing::quantized(shown_rad, units::kDeg * errors_.quantization_deg);
    budget.limits = shown_rad - sensed_rad;
    return shown_rad;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.noise_, self.turned_rad_);
  }

 private:
  VaneErrors errors_;
  random::ScalarNoise noise_;
  double turned_rad_ = 0.0;  ///< the vane's own angle
};

}  // namespace inslab::air_data
