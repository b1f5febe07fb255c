#include "inslab/models/imu/imu_model.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "inslab/data/catalog/checked_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/mount_motion.hpp"

namespace inslab::imu {
namespace {

std::string sensor_name(std::uint32_t number) { return "imu" + std::to_string(number); }

SecondOrderDrift second_order_drift(const ImuErrorProfile& profile) {
  return {profile.gyro_g2_sensitivity_deg_per_h_per_g2, profile.gyro_anisoelasticity_deg_per_h_per_g2,
          profile.gyro_anisoinertia_deg_per_h_per_deg2_per_s2};
}

}  // namespace

ImuModel::ImuModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      rate_(setup.imu_rate),
      gravity_(setup.gravity),
      errors_(setup.errors),
      installation_profile_(setup.installation),
      installation_(catalog::checked_for<catalog::Imu>(setup.installation), setup.gravity),
      vibration_(catalog::checked_for<catalog::Imu>(setup.vibration),
                 {rate_.period_s(), setup.seed, sensor_name(setup.sensor_number)}),
      temperature_(catalog::checked_for<catalog::Imu>(setup.errors).temperature),
      gyro_(gyros_in_si(setup.errors), rate_.period_s(), setup.seed, sensor_name(setup.sensor_number) + "/gyro", "arw"),
      accel_(accels_in_si(setup.errors), rate_.period_s(), setup.seed, sensor_name(setup.sensor_number) + "/accel",
             "vrw"),
      g_sensitivity_(setup.errors.gyro.g_sensitivity_deg_per_h_per_g),
      second_order_drift_(second_order_drift(setup.errors)),
      gyro_thermal_(gyros_in_si(setup.errors)),
      accel_thermal_(accels_in_si(setup.errors)),
      rectification_(setup.errors.accel_rectification_mgal_per_g2),
      size_effect_(setup.errors.accel_place_m),
      gyro_limits_(gyros_in_si(setup.errors), rate_.period_s()),
      accel_limits_(accels_in_si(setup.errors), rate_.period_s()),
      drops_(setup.errors.drop_probability,
             random::Stream(setup.seed, sensor_name(setup.sensor_number) + "/dropped_samples")),
      recording_run_{setup.seed, sensor_name(setup.sensor_number), setup.end, setup.recordings},
      recorded_(setup.errors.recorded_error, recording_run_),
      clock_(setup.errors.time_tag, rate_.period_s(), setup.seed, sensor_name(setup.sensor_number)),
      latency_ns_(time::from_seconds(setup.errors.latency_s).count()),
      revisions_{setup.errors.request.journal_number, setup.vibration.request.journal_number,
                 setup.installation.request.journal_number, 0} {
  use_responses(gyros_in_si(setup.errors), accels_in_si(setup.errors), setup.errors.accel_delay_s);
}

void ImuModel::apply(const ImuErrorProfile& profile) {
  RecordedSignal(profile.recorded_error, recording_run_);  // what cannot be found is refused here
  pending_.emplace_back(catalog::checked_for<catalog::Imu>(profile));
}
void ImuModel::apply(const VibrationProfile& profile) {
  pending_.emplace_back(catalog::checked_for<catalog::Imu>(profile));
}
void ImuModel::apply(const InstallationProfile& profile) {
  pending_.emplace_back(catalog::checked_for<catalog::Imu>(profile));
}
void ImuModel::apply(const FaultProfile& profile) {
  pending_.emplace_back(catalog::checked_for<catalog::Imu>(profile));
}

std::optional<ImuModel::Output> ImuModel::measure(const TruthState& truth) {
  if (!previous_) {
    if (!rate_.contains(time::Nanoseconds(truth.header.sim_time_ns))) return std::nullopt;
    previous_ = truth;
    start_ = installation_.at(truth);
    find_interval(truth.header.sim_time_ns);
    return std::nullopt;
  }
  const std::int64_t previous_ns = previous_->header.sim_time_ns;
  const std::int64_t now_ns = truth.header.sim_time_ns;
  if (truth.interval_ns <= 0 || now_ns - previous_ns != truth.interval_ns || now_ns > to_ns_) {
    throw std::invalid_argument("truth at " + std::to_string(truth.header.sim_time_ns) + " ns over " +
                                std::to_string(truth.interval_ns) + " ns does not continue the one at " +
                                std::to_string(previous_ns) + " ns up to the IMU's instant at " +
                                std::to_string(to_ns_) + " ns");
  }
  if (previous_ns == from_ns_) begin_interval();
  const Installation::Instant end = installation_.at(truth);
  const Increments perfect = perfect_increments(truth, end);
  if (is_followed_) follow_motion(truth, end, perfect);
  perfect_ += perfect;
  start_ = end;
  previous_ = truth;
  if (now_ns != to_ns_) return std::nullopt;
  return end_interval(truth);
}

/// The interval that `from_ns` begins or lies in.
void ImuModel::find_interval(std::int64_t from_ns) {
  interval_.k = rate_.index(time::Nanoseconds(from_ns));
  from_ns_ = rate_.at(interval_.k).count();
  to_ns_ = rate_.at(interval_.k + 1).count();
  interval_.dt_s = time::to_seconds(to_ns_ - from_ns_);
  interval_.stretch = interval_.dt_s / rate_.period_s();
}

void ImuModel::begin_interval() {
  perfect_ = Increments();
  size_effect_dv_.setZero();
  gyro_motion_.begin();
  accel_motion_.begin();
  if (pending_.empty()) return;
  for (const Profile& profile : pending_) std::visit([this](const auto& p) { take(p, interval_.k); }, profile);
  pending_.clear();
}

void ImuModel::use_profiles() {
  tune(errors_, Continuity::Keep, 0);
  installation_ = Installation(installation_profile_, gravity_);
  take(fault_, 0);
}

void ImuModel::find_start() {
  if (!previous_) return;
  start_ = installation_.at(*previous_);
  find_interval(previous_->header.sim_time_ns);
}

void ImuModel::take(const ImuErrorProfile& profile, std::uint64_t k) {
  errors_ = profile;
  tune(profile, profile.request.continuity, k);
  revisions_.imu_error = profile.request.journal_number;
}

void ImuModel::tune(const ImuErrorProfile& profile, Continuity continuity, std::uint64_t k) {
  const TriadParameters gyro = gyros_in_si(profile);
  const TriadParameters accel = accels_in_si(profile);
  temperature_ = Temperature(profile.temperature);
  gyro_.retune(gyro, continuity, k);
  accel_.retune(accel, continuity, k);
  g_sensitivity_ = GSensitivity(profile.gyro.g_sensitivity_deg_per_h_per_g);
  gyro_limits_.retune(gyro, continuity);
  accel_limits_.retune(accel, continuity);
  second_order_drift_ = second_order_drift(profile);
  gyro_thermal_.retune(gyro, continuity);
  accel_thermal_.retune(accel, continuity);
  rectification_ = Rectification(profile.accel_rectification_mgal_per_g2);
  size_effect_ = SizeEffect(profile.accel_place_m);
  use_responses(gyro, accel, profile.accel_delay_s);
  drops_.retune(profile.drop_probability);
  recorded_ = RecordedSignal(profile.recorded_error, recording_run_);
  clock_.retune(profile.time_tag, continuity, k, rate_.at(k).count());
  latency_ns_ = time::from_seconds(profile.latency_s).count();
}

/// Accelerometers that are early are gyros that are late.
void ImuModel::use_responses(const TriadParameters& gyro, const TriadParameters& accel, double accel_delay_s) {
  const std::int64_t delay_ns = time::from_seconds(accel_delay_s).count();
  gyro_motion_.retune(std::max<std::int64_t>(-delay_ns, 0));
  accel_motion_.retune(std::max<std::int64_t>(delay_ns, 0));
  is_filtered_ = !gyro.bandwidth_hz.isZero(0.0) || !accel.bandwidth_hz.isZero(0.0);
  is_followed_ = is_filtered_ || delay_ns != 0 || !size_effect_.is_off();
  bandwidths_ = {low_passes(gyro), low_passes(accel), gyro_motion_.delay_ns(), accel_motion_.delay_ns()};
  vibration_.use(bandwidths_);
}

void ImuModel::take(const VibrationProfile& profile, std::uint64_t) {
  if (vibration_.swap(profile, previous_->header.sim_time_ns, profile.request.fade_s)) relocated();
  revisions_.vibration = profile.request.journal_number;
}

void ImuModel::take(const InstallationProfile& profile, std::uint64_t) {
  const Vector3 old_arm_v_m = installation_.lever_arm_v_m();
  const Quaternion old_q_vb = installation_.q_vb();
  installation_profile_ = profile;
  installation_ = Installation(profile, gravity_);
  find_start();
  if (installation_.lever_arm_v_m() != old_arm_v_m || installation_.q_vb().coeffs() != old_q_vb.coeffs()) relocated();
  revisions_.installation = profile.request.journal_number;
}

void ImuModel::take(const FaultProfile& profile, std::uint64_t) {
  fault_ = profile;
  gyro_.set_fault(profile.gyro_bias_jump_deg_per_h * units::kDegPerH,
                  profile.gyro_noise_burst_deg_per_sqrt_h * units::kDegPerSqrtH);
  accel_.set_fault(profile.accel_bias_jump_mgal * units::kMGal,
                   profile.accel_noise_burst_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH);
  gyro_limits_.set_faults(profile.gyro_axes, profile.gyro_silent);
  accel_limits_.set_faults(profile.accel_axes, profile.accel_silent);
  revisions_.fault = profile.request.journal_number;
}

void ImuModel::relocated() {
  discontinuity_ = true;
  gyro_limits_.relocate();
  accel_limits_.relocate();
  gyro_motion_.relocate();
  accel_motion_.relocate();
}

Increments ImuModel::perfect_increments(const TruthState& truth, const Installation::Instant& end) const {
  if (!vibration_.mount_moves()) return installation_.increments(truth, start_, end);
  return mounted_increments(installation_, *previous_, truth, start_, end, vibration_);
}

/// What motion and vibration do within the interval that ends, with the triads' linear errors.
ImuModel::Within ImuModel::within_interval(const Increments& felt, double temperature_deg_c) {
  const double warmer_k = temperature_deg_c - Temperature::kCalibratedAt;
  const Vibration::Passed passed = vibration_.passed(from_ns_, to_ns_);
  const auto within = [&](const TriadErrors& triad, Unsteady unsteady, const Unsteady& vibration,
                          const Vector3& random_felt, const Vector3& random_passed) {
    unsteady += vibration;
    for (Vector3* part : {&unsteady.y, &unsteady.slope, &unsteady.integral, &unsteady.start_y, &unsteady.start_slope}) {
      *part = triad.sensed(*part, warmer_k);
    }
    return WithinInterval{unsteady, triad.sensed(random_felt, warmer_k), triad.sensed(random_passed, warmer_k)};
  };
  const auto motion = [&](FeltMotion& response, const LowPasses& filters, const Vector3& increment) {
    return response.about(filters, increment / interval_.dt_s, interval_.dt_s);
  };
  return {within(gyro_, motion(gyro_motion_, bandwidths_.gyro, felt.dtheta), passed.gyro, passed.random_felt.dtheta,
                 passed.random_passed.dtheta),
          within(accel_, motion(accel_motion_, bandwidths_.accel, felt.dv), passed.accel, passed.random_felt.dv,
                 passed.random_passed.dv)};
}

std::optional<ImuModel::Output> ImuModel::end_interval(const TruthState& truth) {
  const std::int64_t end_ns = truth.header.sim_time_ns;
  const double temperature_deg_c = temperature_.at(end_ns);

  std::optional<Output> out(std::in_place);  // filled in place: a kilobyte is not worth a copy
  ImuTruth& perfect = out->truth;
  perfect.header = truth.header;
  perfect.header.sequence_number = interval_.k;
  perfect.header.publish_realtime_ns = 0;
  perfect.header.publish_monotonic_ns = 0;
  perfect.sensor_number = sensor_number_;
  perfect.dtheta_b = perfect_.dtheta;
  perfect.dv_b = perfect_.dv;
  perfect.interval_ns = end_ns - from_ns_;
  set_pose(truth, perfect);
  const Increments felt = felt_motion();
  std::optional<Within> within;
  if (is_filtered_) within = within_interval(felt, temperature_deg_c);
  set_errors(felt, vibration_.increments(from_ns_, end_ns), temperature_deg_c, perfect);
  perfect.discontinuity = discontinuity_;
  perfect.revisions = revisions_;
  discontinuity_ = false;

  ImuSample& sample = out->sample;
  sample.header = clock_.is_off() ? perfect.header : clock_.tagged(perfect.header, interval_.k + 1);
  sample.sensor_number = sensor_number_;
  sample.available_sim_time_ns = end_ns + latency_ns_;
  sample.interval_ns = perfect.interval_ns;
  sample.temperature_deg_c = temperature_deg_c;
  sample.revisions = revisions_;
  set_output(*out, within ? &*within : nullptr);
  find_interval(end_ns);
  return out;
}

void ImuModel::set_pose(const TruthState& truth, ImuTruth& perfect) const {
  const auto set = [&perfect](const SensorSite& site, const Quaternion& q_nb) {
    perfect.latitude_rad = site.position.latitude_rad;
    perfect.longitude_rad = site.position.longitude_rad;
    perfect.height_m = site.position.height_m;
    perfect.v_n = site.v_n;
    perfect.q_nb = q_nb;
  };
  if (vibration_.mount_moves()) {
    const MountedPose pose = mounted_pose(installation_, truth, vibration_);
    set(pose.site, pose.q_nb);
  } else {
    set(start_.site, installation_.q_nb(truth, start_));  // start_ has become the end of this interval
  }
}

void ImuModel::set_errors(const Increments& felt, const Increments& vibration, double temperature_deg_c,
                          ImuTruth& perfect) {
  const double warmer_k = temperature_deg_c - Temperature::kCalibratedAt;
  if (is_followed_) {
    perfect.accel_error.size_effect = size_effect_dv_;
    perfect.gyro_error.delay = felt.dtheta - perfect_.dtheta;
    perfect.accel_error.delay = felt.dv - (perfect_.dv + size_effect_dv_);
  }
  gyro_.add_errors(felt.dtheta, vibration.dtheta, warmer_k, interval_, perfect.gyro_error);
  accel_.add_errors(felt.dv, vibration.dv, warmer_k, interval_, perfect.accel_error);
  if (!g_sensitivity_.is_off()) {
    perfect.gyro_error.g_sensitivity = g_sensitivity_.error(perfect_.dv + vibration.dv);
  }
  add_second_order(felt, vibration, perfect);
  add_thermal(temperature_deg_c, perfect);
  if (!recorded_.is_off()) {
    const Increments recorded = recorded_.between(from_ns_, to_ns_);
    perfect.gyro_error.recorded = recorded.dtheta;
    perfect.accel_error.recorded = recorded.dv;
  }
}

/// Biases by squares and products of what is felt, and of the vibration within the interval.
void ImuModel::add_second_order(const Increments& felt, const Increments& vibration, ImuTruth& perfect) {
  if (second_order_drift_.is_of_rate()) {
    perfect.gyro_error.scale += second_order_drift_.of_rate(felt.dtheta + vibration.dtheta, interval_.dt_s);
  }
  if (!second_order_drift_.is_of_force() && rectification_.is_off()) return;
  const Matrix3 moments = vibration_.moments(from_ns_, to_ns_);
  perfect.gyro_error.g_sensitivity += second_order_drift_.of_force(perfect_.dv + vibration.dv, moments, interval_.dt_s);
  perfect.accel_error.bias += rectification_.error(moments, interval_.dt_s);
}

/// Biases by how the temperature changes.
void ImuModel::add_thermal(double temperature_deg_c, ImuTruth& perfect) {
  if (gyro_thermal_.is_off() && accel_thermal_.is_off()) return;
  const double from_deg_c = temperature_.at(from_ns_);
  perfect.gyro_error.bias += gyro_thermal_.error(from_deg_c, temperature_deg_c, interval_.dt_s);
  perfect.accel_error.bias += accel_thermal_.error(from_deg_c, temperature_deg_c, interval_.dt_s);
}

void ImuModel::set_output(Output& out, const Within* within) {
  const bool dropped = drops_.dropped(interval_.k);
  const auto limited = [this, dropped](TriadLimits& limits, const Vector3& perfect, TriadErrorBudget& budget,
                                       const WithinInterval* inside) {
    const Vector3 wanted = perfect + budget.sum();
    TriadLimits::Result result = inside == nullptr ? limits.applied(wanted, dropped, interval_.stretch)
                                                   : limits.applied(wanted, dropped, interval_.stretch, *inside);
    budget.limits = result.increment - wanted;
    return result;
  };
  const TriadLimits::Result gyro =
      limited(gyro_limits_, out.truth.dtheta_b, out.truth.gyro_error, within ? &within->gyro : nullptr);
  const TriadLimits::Result accel =
      limited(accel_limits_, out.truth.dv_b, out.truth.accel_error, within ? &within->accel : nullptr);
  out.sample.dtheta_b = gyro.increment;
  out.sample.dv_b = accel.increment;
  out.sample.mean_omega_ib_b = gyro.increment / interval_.dt_s;
  out.sample.mean_f_b = accel.increment / interval_.dt_s;
  out.sample.gyro_valid = gyro.valid;
  out.sample.accel_valid = accel.valid;
  out.sample.gyro_saturated = gyro.saturated;
  out.sample.accel_saturated = accel.saturated;
}

}  // namespace inslab::imu
