#include "inslab/models/odometer/odometer_model.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/odometer/wheel_turn.hpp"

namespace inslab::odometer {
namespace {

double count_m(const OdometerErrorProfile& errors) {
  return errors.counts_per_revolution > 0.0 ? errors.wheel_circumference_m / errors.counts_per_revolution : 0.0;
}

}  // namespace

OdometerModel::OdometerModel(const Setup& setup)
    : instrument_(setup),
      scale_turn_on_(0.0, instrument_.stream("scale/turn_on")),
      scale_drift_({}, setup.rate.period_s(), instrument_.stream("scale/gm")),
      noise_(instrument_.stream("distance")),
      burst_(instrument_.stream("burst")),
      part_of_count_(instrument_.stream("phase").uniform(0)) {
  take_profiles();
}

void OdometerModel::apply(const OdometerErrorProfile& profile) {
  instrument_.take(profile);
  const std::uint64_t k = instrument_.instant();
  sensing::go_on(profile.request.continuity, k, scale_drift_);
  if (profile.request.continuity == Continuity::Redraw) scale_turn_on_.redraw(k);
  take_profiles();
}

void OdometerModel::apply(const InstallationProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void OdometerModel::apply(const FaultProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void OdometerModel::take_profiles() {
  const OdometerErrorProfile& errors = instrument_.errors();
  contact_.use(instrument_.installation());
  scale_turn_on_.retune(errors.scale_factor_turn_on_sigma_ppm);
  scale_drift_.retune({errors.scale_factor_gm_sigma_ppm, errors.scale_factor_gm_correlation_time_s});
  faulty_.set({instrument_.fault().odometer_fault, AxisFault::None, AxisFault::None});
}

std::optional<WheelTravel> OdometerModel::measure(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (previous_ && previous_->header.sim_time_ns != time_ns - truth.interval_ns) {
    throw std::invalid_argument("the truth at " + std::to_string(time_ns) + " ns does not continue that at " +
                                std::to_string(previous_->header.sim_time_ns) + " ns");
  }
  const OdometerErrorProfile& errors = instrument_.errors();
  if (previous_) turned_m_ += turned_m(contact_.over(*previous_, truth), errors);
  previous_ = truth;
  const std::optional<StreamHeader> tagged = instrument_.reach(truth);
  if (!tagged) return std::nullopt;

  const std::uint64_t k = instrument_.instant();
  const std::int64_t interval_ns = (instrument_.rate().at(k) - instrument_.rate().at(k - 1)).count();
  const double dt_s = time::to_seconds(interval_ns);
  const double distance_m = shown_m(dt_s, time_ns);
  if (instrument_.fault().odometer_silent) return std::nullopt;

  auto sample = instrument_.labelled<WheelTravel>(*tagged);
  sample.interval_ns = interval_ns;
  sample.distance_m = faulty_.applied(Vector3(distance_m, 0.0, 0.0)).x();
  sample.speed_m_per_s = sample.distance_m / dt_s;
  const double one_m = count_m(errors);
  if (one_m > 0.0 && std::isfinite(sample.distance_m)) sample.counts = std::llround(sample.distance_m / one_m);
  sample.direction_known = errors.direction_known;
  return sample;
}

/// What the wheel shows of the present interval, which it closes.
double OdometerModel::shown_m(double dt_s, std::int64_t sim_time_ns) {
  const std::uint64_t k = instrument_.instant();
  const OdometerErrorProfile& errors = instrument_.errors();
  const FaultProfile& fault = instrument_.fault();
  const double scale =
      known_scale(errors, sim_time_ns) + units::kPpm * (scale_turn_on_.value() + scale_drift_.advance(k - 1));
  double distance_m = fault.wheel_locked ? 0.0 : (1.0 + scale) * turned_m_;
  if (errors.noise_m_per_sqrt_m > 0.0) {
    distance_m += errors.noise_m_per_sqrt_m * std::sqrt(std::abs(distance_m)) * noise_.at(k);
  }
  double speed_m_per_s = fault.wheel_speed_jump_m_per_s;
  if (fault.wheel_speed_noise_burst_m_per_s > 0.0) {
    speed_m_per_s += fault.wheel_speed_noise_burst_m_per_s * burst_.at(k);
  }
  turned_m_ = 0.0;
  return counted_m(distance_m + speed_m_per_s * dt_s);
}

/// `distance_m` in whole counts; the rest waits for the next interval.
double OdometerModel::counted_m(double distance_m) {
  const double one_m = count_m(instrument_.errors());
  if (one_m == 0.0) return distance_m;
  const double counts = part_of_count_ + distance_m / one_m;
  part_of_count_ = counts - std::floor(counts);
  return std::floor(counts) * one_m;
}

}  // namespace inslab::odometer
