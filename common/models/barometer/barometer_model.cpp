#include "inslab/models/barometer/barometer_model.hpp"

#include <cmath>

#include "inslab/models/sensing/read_out.hpp"

namespace inslab::barometer {

BarometerModel::BarometerModel(const Setup& setup)
    : instrument_(setup),
      // The air is the same for every sensor in it.
      sea_level_drift_({}, setup.rate.period_s(), instrument_.shared_stream("air/sea_level_pressure")),
      temperature_drift_({}, setup.rate.period_s(), instrument_.shared_stream("air/temperature")),
      noise_(instrument_.stream("pressure"), setup.rate.period_s()),
      temperature_white_(instrument_.stream("temperature/white")),
      burst_(instrument_.stream("burst")) {
  take_profiles();
}

void BarometerModel::apply(const BarometerErrorProfile& profile) {
  instrument_.take(profile);
  sensing::go_on(profile.request.continuity, instrument_.instant(), noise_);
  take_profiles();
}

void BarometerModel::apply(const InstallationProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void BarometerModel::apply(const FaultProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void BarometerModel::take_profiles() {
  const BarometerErrorProfile& errors = instrument_.errors();
  port_.use(errors);
  port_.use(instrument_.installation());
  sea_level_drift_.retune({errors.sea_level_pressure_gm_sigma_pa, errors.sea_level_pressure_gm_correlation_time_s});
  temperature_drift_.retune(
      {errors.temperature_deviation_gm_sigma_deg_c, errors.temperature_deviation_gm_correlation_time_s});
  noise_.retune(errors.white_sigma_pa, errors.gm_sigma_pa, errors.gm_correlation_time_s);
  stuck_.set({instrument_.fault().barometer_fault, AxisFault::None, AxisFault::None});
}

/// All that is random in the sensor at the present instant.
BarometerModel::Noise BarometerModel::drawn() {
  const std::uint64_t k = instrument_.instant();
  const double burst_pa = instrument_.fault().pressure_noise_burst_pa;
  const double white_deg_c = instrument_.errors().temperature_white_sigma_deg_c;
  Noise noise;
  noise.pressure_pa = noise_.advance(k);
  if (burst_pa > 0.0) noise.pressure_pa += burst_pa * burst_.at(k);
  if (white_deg_c > 0.0) noise.temperature_deg_c = white_deg_c * temperature_white_.at(k);
  return noise;
}

std::optional<AirPressure> BarometerModel::observe(const TruthState& truth) {
  const std::optional<StreamHeader> tagged = instrument_.reach(truth);
  if (!tagged) return std::nullopt;
  const std::uint64_t before = instrument_.instant() - 1;
  const Weather drift{sea_level_drift_.advance(before), temperature_drift_.advance(before)};
  const nav::standard_atmosphere::Air air = port_.air(truth, drift);
  const Noise noise = drawn();
  const FaultProfile& fault = instrument_.fault();
  if (fault.barometer_silent) return std::nullopt;

  const BarometerErrorProfile& errors = instrument_.errors();
  auto sample = instrument_.labelled<AirPressure>(*tagged);
  double pressure_pa = air.pressure_pa + errors.offset_pa + noise.pressure_pa + fault.pressure_jump_pa;
  const double most_pa = errors.max_pressure_pa > 0.0 ? errors.max_pressure_pa : HUGE_VAL;
  sample.saturated = sensing::cut(pressure_pa, errors.min_pressure_pa, most_pa);
  pressure_pa = sensing::quantized(pressure_pa, errors.quantization_pa);
  sample.pressure_pa = stuck_.applied(Vector3(pressure_pa, 0.0, 0.0)).x();
  sample.pressure_altitude_m = nav::standard_atmosphere::pressure_altitude_m(sample.pressure_pa);
  const double temperature_deg_c = air.temperature_k - nav::standard_atmosphere::kZeroCelsiusK +
                                   errors.temperature_offset_deg_c + noise.temperature_deg_c;
  sample.temperature_deg_c = sensing::quantized(temperature_deg_c, errors.temperature_quantization_deg_c);
  return sample;
}

}  // namespace inslab::barometer
