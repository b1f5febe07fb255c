#include "inslab/models/barometer/barometer_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "inslab/data/catalog/checked_profile.hpp"

namespace inslab::barometer {
namespace {

random::Stream stream(const BarometerModel::Setup& setup, const char* what) {
  return {setup.seed, "barometer" + std::to_string(setup.sensor_number) + "/" + what};
}

/// The air is the same for every sensor in it.
random::GaussMarkov weather(const BarometerModel::Setup& setup, const char* what) {
  return {{}, setup.rate.period_s(), random::Stream(setup.seed, std::string("air/") + what)};
}

double quantized(double value, double count) { return count > 0.0 ? std::nearbyint(value / count) * count : value; }

}  // namespace

BarometerModel::BarometerModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      rate_(setup.rate),
      errors_(catalog::checked_for<catalog::Barometer>(setup.errors)),
      installation_(catalog::checked_for<catalog::Barometer>(setup.installation)),
      sea_level_drift_(weather(setup, "sea_level_pressure")),
      temperature_drift_(weather(setup, "temperature")),
      drift_({}, setup.rate.period_s(), stream(setup, "pressure/gm")),
      white_(stream(setup, "pressure/white")),
      temperature_white_(stream(setup, "temperature/white")),
      burst_(stream(setup, "burst")),
      clock_(setup.errors.time_tag, setup.rate.period_s(), setup.seed,
             "barometer" + std::to_string(setup.sensor_number)) {
  take_profiles();
}

void BarometerModel::apply(const BarometerErrorProfile& profile) {
  errors_ = catalog::checked_for<catalog::Barometer>(profile);
  if (profile.request.continuity == Continuity::Reset) drift_.reset();
  if (profile.request.continuity == Continuity::Redraw) drift_.redraw(instant_);
  clock_.retune(profile.time_tag, profile.request.continuity, instant_, rate_.at(instant_).count());
  take_profiles();
}

void BarometerModel::apply(const InstallationProfile& profile) {
  installation_ = catalog::checked_for<catalog::Barometer>(profile);
  take_profiles();
}

void BarometerModel::apply(const FaultProfile& profile) {
  fault_ = catalog::checked_for<catalog::Barometer>(profile);
  take_profiles();
}

void BarometerModel::take_profiles() {
  port_.use(errors_);
  port_.use(installation_);
  sea_level_drift_.retune({errors_.sea_level_pressure_gm_sigma_pa, errors_.sea_level_pressure_gm_correlation_time_s});
  temperature_drift_.retune(
      {errors_.temperature_deviation_gm_sigma_deg_c, errors_.temperature_deviation_gm_correlation_time_s});
  drift_.retune({errors_.gm_sigma_pa, errors_.gm_correlation_time_s});
  clock_.use(errors_.time_tag);
  stuck_.set({fault_.barometer_fault, AxisFault::None, AxisFault::None});
}

/// All that is random in the sensor at the present instant.
BarometerModel::Noise BarometerModel::drawn() {
  Noise noise;
  noise.pressure_pa = errors_.white_sigma_pa * white_.at(instant_) + drift_.advance(instant_ - 1);
  if (fault_.pressure_noise_burst_pa > 0.0) {
    noise.pressure_pa += fault_.pressure_noise_burst_pa * burst_.at(instant_);
  }
  if (errors_.temperature_white_sigma_deg_c > 0.0) {
    noise.temperature_deg_c = errors_.temperature_white_sigma_deg_c * temperature_white_.at(instant_);
  }
  return noise;
}

std::optional<AirPressure> BarometerModel::observe(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (time_ns <= 0 || !rate_.contains(time::Nanoseconds(time_ns))) return std::nullopt;
  instant_ = rate_.index(time::Nanoseconds(time_ns));
  const StreamHeader header = clock_.tagged(truth.header, instant_);
  const Weather drift{sea_level_drift_.advance(instant_ - 1), temperature_drift_.advance(instant_ - 1)};
  const nav::standard_atmosphere::Air air = port_.air(truth, drift);
  const Noise noise = drawn();
  if (fault_.barometer_silent) return std::nullopt;

  AirPressure sample;
  sample.header = header;
  sample.header.sequence_number = samples_++;
  sample.header.publish_realtime_ns = 0;
  sample.header.publish_monotonic_ns = 0;
  sample.sensor_number = sensor_number_;
  const double pressure_pa = air.pressure_pa + errors_.offset_pa + noise.pressure_pa + fault_.pressure_jump_pa;
  const double most_pa = errors_.max_pressure_pa > 0.0 ? errors_.max_pressure_pa : HUGE_VAL;
  const double shown_pa = std::clamp(pressure_pa, errors_.min_pressure_pa, most_pa);
  sample.saturated = shown_pa != pressure_pa;
  sample.pressure_pa = stuck_.applied(Vector3(quantized(shown_pa, errors_.quantization_pa), 0.0, 0.0)).x();
  sample.pressure_altitude_m = nav::standard_atmosphere::pressure_altitude_m(sample.pressure_pa);
  sample.temperature_deg_c = quantized(air.temperature_k - nav::standard_atmosphere::kZeroCelsiusK +
                                           errors_.temperature_offset_deg_c + noise.temperature_deg_c,
                                       errors_.temperature_quantization_deg_c);
  sample.revisions = {errors_.request.journal_number, installation_.request.journal_number,
                      fault_.request.journal_number};
  return sample;
}

}  // namespace inslab::barometer
