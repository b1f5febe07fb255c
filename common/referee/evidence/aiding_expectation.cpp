#include "inslab/referee/evidence/aiding_expectation.hpp"

#include "inslab/models/odometer/wheel_turn.hpp"

namespace inslab::evidence {
double PressureExpectation::pressure_pa(const AirPressure& sample, const TruthState& vehicle,
                                        const LogSummary& summary) {
  const BarometerRevisions& now = sample.revisions;
  if (!revisions_ || revisions_->barometer_error != now.barometer_error ||
      revisions_->installation != now.installation) {
    const SensorAddress sensor{SensorKind::Barometer, sample.sensor_number};
    port_.use(profile_in_use<BarometerErrorProfile>(summary, sensor, sample.header.sim_time_ns));
    port_.use(profile_in_use<InstallationProfile>(summary, sensor, sample.header.sim_time_ns));
    revisions_ = now;
  }
  return port_.air(vehicle, {}).pressure_pa;
}

double WayExpectation::distance_m(const WheelTravel& sample, const std::vector<const TruthState*>& way,
                                  const LogSummary& summary) {
  const OdometerRevisions& now = sample.revisions;
  if (!revisions_ || revisions_->odometer_error != now.odometer_error || revisions_->installation != now.installation) {
    const SensorAddress sensor{SensorKind::Odometer, sample.sensor_number};
    errors_ = profile_in_use<OdometerErrorProfile>(summary, sensor, sample.header.sim_time_ns);
    errors_.scale_factor_ppm = 0.0;
    contact_.use(profile_in_use<InstallationProfile>(summary, sensor, sample.header.sim_time_ns));
    revisions_ = now;
  }
  double turned_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    turned_m += odometer::turned_m(contact_.over(*way[i - 1], *way[i]), errors_);
  }
  return (1.0 + odometer::known_scale(errors_, sample.header.sim_time_ns)) * turned_m;
}

}  // namespace inslab::evidence
