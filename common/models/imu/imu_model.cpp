#include "inslab/models/imu/imu_model.hpp"

#include <stdexcept>
#include <string>

#include "inslab/data/catalog/checked_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/mount_motion.hpp"

namespace inslab::imu {
namespace {

std::string sensor_name(std::uint32_t number) { return "imu" + std::to_string(number); }

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
      gyro_(in_si(setup.errors.gyro), rate_.period_s(), setup.seed, sensor_name(setup.sensor_number) + "/gyro", "arw"),
      accel_(in_si(setup.errors.accel), rate_.period_s(), setup.seed, sensor_name(setup.sensor_number) + "/accel",
             "vrw"),
      g_sensitivity_(setup.errors.gyro.g_sensitivity_deg_per_h_per_g),
      gyro_limits_(in_si(setup.errors.gyro), rate_.period_s()),
      accel_limits_(in_si(setup.errors.accel), rate_.period_s()),
      drops_(setup.errors.drop_probability,
             random::Stream(setup.seed, sensor_name(setup.sensor_number) + "/dropped_samples")),
      recording_run_{setup.seed, sensor_name(setup.sensor_number), setup.end, setup.recordings},
      recorded_(setup.errors.recorded_error, recording_run_),
      latency_ns_(time::from_seconds(setup.errors.latency_s).count()),
      revisions_{setup.errors.request.journal_number, setup.vibration.request.journal_number,
                 setup.installation.request.journal_number, 0} {
  use_bandwidths(in_si(setup.errors.gyro), in_si(setup.errors.accel));
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
  if (is_filtered_) follow_motion(truth, end, perfect);
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
  const TriadParameters gyro = in_si(profile.gyro);
  const TriadParameters accel = in_si(profile.accel);
  temperature_ = Temperature(profile.temperature);
  gyro_.retune(gyro, continuity, k);
  accel_.retune(accel, continuity, k);
  g_sensitivity_ = GSensitivity(profile.gyro.g_sensitivity_deg_per_h_per_g);
  gyro_limits_.retune(gyro, continuity);
  accel_limits_.retune(accel, continuity);
  use_bandwidths(gyro, accel);
  drops_.retune(profile.drop_probability);
  recorded_ = RecordedSignal(profile.recorded_error, recording_run_);
  latency_ns_ = time::from_seconds(profile.latency_s).count();
}

void ImuModel::use_bandwidths(const TriadParameters& gyro, const TriadParameters& accel) {
  is_filtered_ = !gyro.bandwidth_hz.isZero(0.0) || !accel.bandwidth_hz.isZero(0.0);
  bandwidths_ = {low_passes(gyro), low_passes(accel)};
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
}

Increments ImuModel::perfect_increments(const TruthState& truth, const Installation::Instant& end) const {
  if (!vibration_.mount_moves()) return installation_.increments(truth, start_, end);
  return mounted_increments(installation_, *previous_, truth, start_, end, vibration_);
}

/// What the filters make of the motion up to `truth`. Of a moving mount they see the means over the truth's intervals.
void ImuModel::follow_motion(const TruthState& truth, const Installation::Instant& end, const Increments& perfect) {
  const double dt_s = time::to_seconds(truth.interval_ns);
  MotionPiece piece;
  if (vibration_.mount_moves()) {
    piece.omega = {perfect.dtheta / dt_s, Vector3::Zero(), Vector3::Zero()};
    piece.f = {perfect.dv / dt_s, Vector3::Zero(), Vector3::Zero()};
  } else {
    piece = motion_piece(installation_, *previous_, truth, start_, end, perfect);
  }
  gyro_motion_.add(bandwidths_.gyro, piece.omega, Vector3::Zero(), dt_s);
  accel_motion_.add(bandwidths_.accel, piece.f, piece.impulse, dt_s);
}

/// What motion and vibration do within the interval that ends, with the triads' linear errors.
ImuModel::Within ImuModel::within_interval(double temperature_deg_c) {
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
  const auto motion = [&](MotionResponse& response, const LowPasses& filters, const Vector3& increment) {
    return response.about(filters, increment / interval_.dt_s, interval_.dt_s);
  };
  return {within(gyro_, motion(gyro_motion_, bandwidths_.gyro, perfect_.dtheta), passed.gyro, passed.random_felt.dtheta,
                 passed.random_passed.dtheta),
          within(accel_, motion(accel_motion_, bandwidths_.accel, perfect_.dv), passed.accel, passed.random_felt.dv,
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
  std::optional<Within> within;
  if (is_filtered_) within = within_interval(temperature_deg_c);
  set_errors(vibration_.increments(from_ns_, end_ns), temperature_deg_c, perfect);
  perfect.discontinuity = discontinuity_;
  perfect.revisions = revisions_;
  discontinuity_ = false;

  ImuSample& sample = out->sample;
  sample.header = perfect.header;
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

void ImuModel::set_errors(const Increments& vibration, double temperature_deg_c, ImuTruth& perfect) {
  const double warmer_k = temperature_deg_c - Temperature::kCalibratedAt;
  gyro_.add_errors(perfect_.dtheta, vibration.dtheta, warmer_k, interval_, perfect.gyro_error);
  accel_.add_errors(perfect_.dv, vibration.dv, warmer_k, interval_, perfect.accel_error);
  if (!g_sensitivity_.is_off()) {
    perfect.gyro_error.g_sensitivity = g_sensitivity_.error(perfect_.dv + vibration.dv);
  }
  if (!recorded_.is_off()) {
    const Increments recorded = recorded_.between(from_ns_, to_ns_);
    perfect.gyro_error.recorded = recorded.dtheta;
    perfect.accel_error.recorded = recorded.dv;
  }
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
