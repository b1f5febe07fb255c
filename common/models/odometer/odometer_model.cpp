#include "inslab/models/odometer/odometer_model.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "inslab/data/catalog/checked_profile.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/odometer/wheel_turn.hpp"

namespace inslab::odometer {
namespace {

random::Stream stream(const OdometerModel::Setup& setup, const char* what) {
  return {setup.seed, "odometer" + std::to_string(setup.sensor_number) + "/" + what};
}

double count_m(const OdometerErrorProfile& errors) {
  return errors.counts_per_revolution > 0.0 ? errors.wheel_circumference_m / errors.counts_per_revolution : 0.0;
}

}  // namespace

OdometerModel::OdometerModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      rate_(setup.rate),
      errors_(catalog::checked_for<catalog::Odometer>(setup.errors)),
      installation_(catalog::checked_for<catalog::Odometer>(setup.installation)),
      scale_turn_on_(0.0, stream(setup, "scale/turn_on")),
      scale_drift_({}, setup.rate.period_s(), stream(setup, "scale/gm")),
      noise_(stream(setup, "distance")),
      burst_(stream(setup, "burst")),
      clock_(setup.errors.time_tag, setup.rate.period_s(), setup.seed,
             "odometer" + std::to_string(setup.sensor_number)),
      part_of_count_(stream(setup, "phase").uniform(0)) {
  take_profiles();
}

void OdometerModel::apply(const OdometerErrorProfile& profile) {
  errors_ = catalog::checked_for<catalog::Odometer>(profile);
  if (profile.request.continuity == Continuity::Reset) scale_drift_.reset();
  const std::int64_t now_ns = previous_ ? previous_->header.sim_time_ns : 0;
  const std::uint64_t k = rate_.index(time::Nanoseconds(now_ns));
  if (profile.request.continuity == Continuity::Redraw) {
    scale_turn_on_.redraw(k);
    scale_drift_.redraw(k);
  }
  clock_.retune(profile.time_tag, profile.request.continuity, k, rate_.at(k).count());
  take_profiles();
}

void OdometerModel::apply(const InstallationProfile& profile) {
  installation_ = catalog::checked_for<catalog::Odometer>(profile);
  take_profiles();
}

void OdometerModel::apply(const FaultProfile& profile) {
  fault_ = catalog::checked_for<catalog::Odometer>(profile);
  take_profiles();
}

void OdometerModel::take_profiles() {
  contact_.use(installation_);
  scale_turn_on_.retune(errors_.scale_factor_turn_on_sigma_ppm);
  scale_drift_.retune({errors_.scale_factor_gm_sigma_ppm, errors_.scale_factor_gm_correlation_time_s});
  clock_.use(errors_.time_tag);
  faulty_.set({fault_.odometer_fault, AxisFault::None, AxisFault::None});
}

std::optional<WheelTravel> OdometerModel::measure(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (previous_ && previous_->header.sim_time_ns != time_ns - truth.interval_ns) {
    throw std::invalid_argument("the truth at " + std::to_string(time_ns) + " ns does not continue that at " +
                                std::to_string(previous_->header.sim_time_ns) + " ns");
  }
  if (previous_) turned_m_ += turned_m(contact_.over(*previous_, truth), errors_);
  previous_ = truth;
  if (time_ns <= 0 || !rate_.contains(time::Nanoseconds(time_ns))) return std::nullopt;

  const std::uint64_t k = rate_.index(time::Nanoseconds(time_ns));
  WheelTravel sample;
  sample.header = clock_.tagged(truth.header, k);
  sample.interval_ns = (rate_.at(k) - rate_.at(k - 1)).count();
  const double dt_s = time::to_seconds(sample.interval_ns);
  const double distance_m = shown_m(k, dt_s, time_ns);
  if (fault_.odometer_silent) return std::nullopt;

  sample.header.sequence_number = samples_++;
  sample.header.publish_realtime_ns = 0;
  sample.header.publish_monotonic_ns = 0;
  sample.sensor_number = sensor_number_;
  sample.distance_m = faulty_.applied(Vector3(distance_m, 0.0, 0.0)).x();
  sample.speed_m_per_s = sample.distance_m / dt_s;
  const double one_m = count_m(errors_);
  if (one_m > 0.0 && std::isfinite(sample.distance_m)) sample.counts = std::llround(sample.distance_m / one_m);
  sample.direction_known = errors_.direction_known;
  sample.revisions = {errors_.request.journal_number, installation_.request.journal_number,
                      fault_.request.journal_number};
  return sample;
}

/// What the wheel shows of interval k, which it closes.
double OdometerModel::shown_m(std::uint64_t k, double dt_s, std::int64_t sim_time_ns) {
  const double scale =
      known_scale(errors_, sim_time_ns) + units::kPpm * (scale_turn_on_.value() + scale_drift_.advance(k - 1));
  double distance_m = fault_.wheel_locked ? 0.0 : (1.0 + scale) * turned_m_;
  if (errors_.noise_m_per_sqrt_m > 0.0) {
    distance_m += errors_.noise_m_per_sqrt_m * std::sqrt(std::abs(distance_m)) * noise_.at(k);
  }
  double speed_m_per_s = fault_.wheel_speed_jump_m_per_s;
  if (fault_.wheel_speed_noise_burst_m_per_s > 0.0) {
    speed_m_per_s += fault_.wheel_speed_noise_burst_m_per_s * burst_.at(k);
  }
  turned_m_ = 0.0;
  return counted_m(distance_m + speed_m_per_s * dt_s);
}

/// `distance_m` in whole counts; the rest waits for the next interval.
double OdometerModel::counted_m(double distance_m) {
  const double one_m = count_m(errors_);
  if (one_m == 0.0) return distance_m;
  const double counts = part_of_count_ + distance_m / one_m;
  part_of_count_ = counts - std::floor(counts);
  return std::floor(counts) * one_m;
}

}  // namespace inslab::odometer
