#include "inslab/models/magnetometer/magnetometer_model.hpp"

#include "inslab/models/sensing/read_out.hpp"

namespace inslab::magnetometer {

MagnetometerModel::MagnetometerModel(const Setup& setup)
    : instrument_(setup),
      noise_(instrument_.stream("field"), random::VectorNoise::kAxes, setup.rate.period_s()),
      burst_(instrument_.stream("burst"), random::VectorNoise::kAxes, setup.rate.period_s()) {
  take_profiles();
}

void MagnetometerModel::apply(const MagnetometerErrorProfile& profile) {
  instrument_.take(profile);
  sensing::go_on(profile.request.continuity, instrument_.instant(), noise_);
  take_profiles();
}

void MagnetometerModel::apply(const InstallationProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void MagnetometerModel::apply(const FaultProfile& profile) {
  instrument_.take(profile);
  take_profiles();
}

void MagnetometerModel::take_profiles() {
  const MagnetometerErrorProfile& errors = instrument_.errors();
  const FaultProfile& fault = instrument_.fault();
  response_ = response(errors);
  field_.use(instrument_.installation());
  field_.use(errors.bodies);
  currents_nt_ = currents_nt(errors);
  noise_.retune(errors.white_sigma_nt, errors.gm_sigma_nt, errors.gm_correlation_time_s);
  burst_.retune(fault.magnetic_noise_burst_nt, Vector3::Zero(), Vector3::Zero());
  axes_.set(fault.magnetometer_axes);
}

std::optional<MagneticField> MagnetometerModel::observe(const TruthState& truth) {
  const std::optional<StreamHeader> tagged = instrument_.reach(truth);
  if (!tagged) return std::nullopt;
  const std::uint64_t k = instrument_.instant();
  const Vector3 noise_nt = noise_.advance(k) + burst_.advance(k);
  const FaultProfile& fault = instrument_.fault();
  if (fault.magnetometer_silent) return std::nullopt;

  const MagnetometerErrorProfile& errors = instrument_.errors();
  auto sample = instrument_.labelled<MagneticField>(*tagged);
  Vector3 B_b = response_ * field_.B_b_nt(truth) + errors.hard_iron_nt + currents_nt_.at(truth.header.sim_time_ns) +
                noise_nt + fault.magnetic_jump_nt;
  sample.saturated = sensing::cut(B_b, errors.full_scale_nt);
  sample.B_b_nt = axes_.applied(sensing::quantized(B_b, errors.quantization_nt));
  return sample;
}

}  // namespace inslab::magnetometer
