#include "inslab/models/magnetometer/magnetometer_model.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "inslab/data/catalog/checked_profile.hpp"

namespace inslab::magnetometer {
namespace {

random::Stream stream(const MagnetometerModel::Setup& setup, const char* what) {
  return {setup.seed, "magnetometer" + std::to_string(setup.sensor_number) + "/" + what};
}

/// `field` in whole counts; an axis whose count is 0 as it is.
Vector3 quantized(const Vector3& field, const Vector3& count) {
  Vector3 out = field;
  for (int axis = 0; axis < 3; ++axis) {
    if (count[axis] > 0.0) out[axis] = std::nearbyint(field[axis] / count[axis]) * count[axis];
  }
  return out;
}

/// Cuts `field` at full scale, 0 being none, and says whether an axis was there.
bool saturate(Vector3& field, const Vector3& full_scale) {
  bool cut = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (full_scale[axis] == 0.0 || !(std::abs(field[axis]) > full_scale[axis])) continue;
    field[axis] = std::copysign(full_scale[axis], field[axis]);
    cut = true;
  }
  return cut;
}

}  // namespace

MagnetometerModel::MagnetometerModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      rate_(setup.rate),
      errors_(catalog::checked_for<catalog::Magnetometer>(setup.errors)),
      installation_(catalog::checked_for<catalog::Magnetometer>(setup.installation)),
      noise_(stream(setup, "field"), random::VectorNoise::kAxes, setup.rate.period_s()),
      burst_(stream(setup, "burst"), random::VectorNoise::kAxes, setup.rate.period_s()),
      clock_(setup.errors.time_tag, setup.rate.period_s(), setup.seed,
             "magnetometer" + std::to_string(setup.sensor_number)) {
  take_profiles();
}

void MagnetometerModel::apply(const MagnetometerErrorProfile& profile) {
  errors_ = catalog::checked_for<catalog::Magnetometer>(profile);
  if (profile.request.continuity == Continuity::Reset) noise_.reset();
  if (profile.request.continuity == Continuity::Redraw) noise_.redraw(instant_);
  clock_.retune(profile.time_tag, profile.request.continuity, instant_, rate_.at(instant_).count());
  take_profiles();
}

void MagnetometerModel::apply(const InstallationProfile& profile) {
  installation_ = catalog::checked_for<catalog::Magnetometer>(profile);
  take_profiles();
}

void MagnetometerModel::apply(const FaultProfile& profile) {
  fault_ = catalog::checked_for<catalog::Magnetometer>(profile);
  take_profiles();
}

void MagnetometerModel::take_profiles() {
  response_ = response(errors_);
  field_.use(installation_);
  field_.use(errors_.bodies);
  currents_nt_ = currents_nt(errors_);
  noise_.retune(errors_.white_sigma_nt, errors_.gm_sigma_nt, errors_.gm_correlation_time_s);
  burst_.retune(fault_.magnetic_noise_burst_nt, Vector3::Zero(), Vector3::Zero());
  axes_.set(fault_.magnetometer_axes);
  clock_.use(errors_.time_tag);
}

std::optional<MagneticField> MagnetometerModel::observe(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (time_ns <= 0 || !rate_.contains(time::Nanoseconds(time_ns))) return std::nullopt;
  instant_ = rate_.index(time::Nanoseconds(time_ns));
  const StreamHeader header = clock_.tagged(truth.header, instant_);
  const Vector3 noise_nt = noise_.advance(instant_) + burst_.advance(instant_);
  if (fault_.magnetometer_silent) return std::nullopt;

  MagneticField sample;
  sample.header = header;
  sample.header.sequence_number = samples_++;
  sample.header.publish_realtime_ns = 0;
  sample.header.publish_monotonic_ns = 0;
  sample.sensor_number = sensor_number_;
  Vector3 B_b = response_ * field_.B_b_nt(truth) + errors_.hard_iron_nt + currents_nt_.at(time_ns) + noise_nt +
                fault_.magnetic_jump_nt;
  sample.saturated = saturate(B_b, errors_.full_scale_nt);
  sample.B_b_nt = axes_.applied(quantized(B_b, errors_.quantization_nt));
  sample.revisions = {errors_.request.journal_number, installation_.request.journal_number,
                      fault_.request.journal_number};
  return sample;
}

}  // namespace inslab::magnetometer
