#include "inslab/models/air_data/air_data_model.hpp"

#include "inslab/nav/compressible_flow.hpp"

namespace inslab::air_data {

AirDataModel::AirDataModel(const Setup& setup)
    : instrument_(setup),
      air_(setup.rate.period_s(), [this](const char* name) { return instrument_.shared_stream(name); }),
      impact_(instrument_.stream("impact_pressure"), setup.rate.period_s()),
      static_(instrument_.stream("static_pressure"), setup.rate.period_s()),
      attack_(instrument_.stream("angle_of_attack"), setup.rate.period_s()),
      sideslip_(instrument_.stream("angle_of_sideslip"), setup.rate.period_s()),
      temperature_white_(instrument_.stream("temperature/white")) {
  take_profiles();
}

void AirDataModel::apply(const AirDataErrorProfile& profile) {
  instrument_.take(profile);
  const Continuity continuity = profile.request.continuity;
  for (PressureSensor* sensor : {&impact_, &static_}) sensor->go_on(continuity, instrument_.instant());
  for (Vane* vane : {&attack_, &sideslip_}) vane->go_on(continuity, instrument_.instant());
  take_profiles();
}

void AirDataModel::apply(const InstallationProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void AirDataModel::apply(const FaultProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void AirDataModel::take_profiles() {
  const AirDataErrorProfile& errors = instrument_.errors();
  air_.use(errors);
  air_.use(instrument_.installation());
  lines_.use(errors);
  lines_.use(instrument_.fault());
  impact_.use(errors.impact_pressure);
  static_.use(errors.static_pressure);
  attack_.use(errors.angle_of_attack);
  sideslip_.use(errors.angle_of_sideslip);
}

double AirDataModel::total_temperature_deg_c(const Airstream& stream) {
  const AirDataErrorProfile& errors = instrument_.errors();
  const double heating = nav::compressible_flow::temperature_ratio(stream.mach) - 1.0;
  double sensed_deg_c = stream.air.temperature_k * (1.0 + errors.recovery_factor * heating) -
                        nav::standard_atmosphere::kZeroCelsiusK + errors.temperature_offset_deg_c;
  if (errors.temperature_white_sigma_deg_c > 0.0) {
    sensed_deg_c += errors.temperature_white_sigma_deg_c * temperature_white_.at(instrument_.instant());
  }
  return sensed_deg_c;
}

std::optional<AirDataModel::Output> AirDataModel::observe(const TruthState& truth) {
  const std::optional<StreamHeader> tagged = instrument_.reach(truth);
  if (!tagged) return std::nullopt;
  const std::uint64_t k = instrument_.instant();
  const Airstream stream = air_.at(k, truth);

  Output output;
  Airflow& sample = output.sample = instrument_.labelled<Airflow>(*tagged);
  AirflowTruth& perfect = output.truth;
  perfect.header = sample.header;
  perfect.header.gps_week = truth.header.gps_week;
  perfect.header.gps_time_of_week_ns = truth.header.gps_time_of_week_ns;
  perfect.sensor_number = sample.sensor_number;
  perfect.revisions = sample.revisions;
  perfect.wind_ned_m_per_s = stream.wind_ned_m_per_s;
  perfect.gust_ned_m_per_s = stream.gust_ned_m_per_s;
  perfect.true_airspeed_m_per_s = stream.airspeed_m_per_s;
  perfect.impact_pressure_pa = stream.impact_pressure_pa;
  perfect.static_pressure_pa = stream.air.pressure_pa;
  perfect.static_temperature_deg_c = stream.air.temperature_k - nav::standard_atmosphere::kZeroCelsiusK;
  perfect.angle_of_attack_rad = stream.angle_of_attack_rad;
  perfect.angle_of_sideslip_rad = stream.angle_of_sideslip_rad;

  const PitotLines::Pressures lines = lines_.follow(truth.header.sim_time_ns, stream, perfect);
  sample.impact_pressure_pa =
      impact_.shown_pa(k, lines.pitot_pa - lines.static_pa, perfect.impact_pressure_error, sample.saturated);
  sample.static_pressure_pa = static_.shown_pa(k, lines.static_pa, perfect.static_pressure_error, sample.saturated);
  const bool frozen = instrument_.fault().vanes_frozen;
  sample.angle_of_attack_rad =
      attack_.shown_rad(k, stream.angle_of_attack_rad, frozen, perfect.angle_of_attack_error, sample.saturated);
  sample.angle_of_sideslip_rad =
      sideslip_.shown_rad(k, stream.angle_of_sideslip_rad, frozen, perfect.angle_of_sideslip_error, sample.saturated);
  sample.total_temperature_deg_c = total_temperature_deg_c(stream);
  sample.compute();
  return output;
}

}  // namespace inslab::air_data
