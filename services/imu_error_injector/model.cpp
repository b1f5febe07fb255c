#include "services/imu_error_injector/model.hpp"

#include <stdexcept>
#include <string>

#include "samples/profile_rules.hpp"

namespace inslab::imu {
namespace {

template <class Profile>
const Profile& checked(const Profile& profile) {
  if (const auto broken = violation(profile)) throw std::invalid_argument(broken->path + " " + broken->reason);
  if (profile.target.kind != SensorKind::Imu) throw std::invalid_argument("target_kind is not imu");
  return profile;
}

std::string sensor_name(std::uint32_t number) { return "imu" + std::to_string(number); }

}  // namespace

ImuModel::ImuModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      truth_period_ns_(setup.truth_rate.period().count()),
      imu_period_ns_(setup.imu_rate.multiple_of(setup.truth_rate) * truth_period_ns_),
      gravity_(setup.gravity),
      installation_(checked(setup.installation), setup.gravity),
      vibration_(checked(setup.vibration)),
      gyro_(in_si(checked(setup.errors).gyro), setup.imu_rate.period_s(), setup.seed,
            sensor_name(setup.sensor_number) + "/gyro", "arw"),
      accel_(in_si(setup.errors.accel), setup.imu_rate.period_s(), setup.seed,
             sensor_name(setup.sensor_number) + "/accel", "vrw"),
      revisions_{setup.errors.request.journal_number, setup.vibration.request.journal_number,
                 setup.installation.request.journal_number, 0} {}

void ImuModel::apply(const ImuErrorProfile& profile) { pending_.emplace_back(checked(profile)); }
void ImuModel::apply(const VibrationProfile& profile) { pending_.emplace_back(checked(profile)); }
void ImuModel::apply(const InstallationProfile& profile) { pending_.emplace_back(checked(profile)); }
void ImuModel::apply(const FaultProfile& profile) { pending_.emplace_back(checked(profile)); }

std::optional<ImuModel::Output> ImuModel::measure(const TruthState& truth) {
  if (!previous_) {
    if (truth.header.sim_time_ns % imu_period_ns_ != 0) return std::nullopt;
    previous_ = truth;
    start_ = installation_.at(truth);
    return std::nullopt;
  }
  const std::int64_t previous_ns = previous_->header.sim_time_ns;
  if (truth.interval_ns != truth_period_ns_ || truth.header.sim_time_ns - previous_ns != truth_period_ns_) {
    throw std::invalid_argument("truth at " + std::to_string(truth.header.sim_time_ns) + " ns over " +
                                std::to_string(truth.interval_ns) + " ns does not continue the one at " +
                                std::to_string(previous_ns) + " ns");
  }
  if (previous_ns % imu_period_ns_ == 0) begin_interval();
  const Installation::Instant end = installation_.at(truth);
  perfect_ += installation_.increments(truth, start_, end);
  start_ = end;
  previous_ = truth;
  if (truth.header.sim_time_ns % imu_period_ns_ != 0) return std::nullopt;
  return end_interval(truth);
}

void ImuModel::begin_interval() {
  perfect_ = Increments();
  if (pending_.empty()) return;
  const auto k = static_cast<std::uint64_t>(previous_->header.sim_time_ns / imu_period_ns_);
  for (const Profile& profile : pending_) std::visit([this, k](const auto& p) { take(p, k); }, profile);
  pending_.clear();
}

void ImuModel::take(const ImuErrorProfile& profile, std::uint64_t k) {
  gyro_.retune(in_si(profile.gyro), profile.request.continuity, k);
  accel_.retune(in_si(profile.accel), profile.request.continuity, k);
  revisions_.imu_error = profile.request.journal_number;
}

void ImuModel::take(const VibrationProfile& profile, std::uint64_t) {
  vibration_.swap(profile, previous_->header.sim_time_ns, profile.request.fade_s);
  revisions_.vibration = profile.request.journal_number;
}

void ImuModel::take(const InstallationProfile& profile, std::uint64_t) {
  const Vector3 old_arm_v_m = installation_.lever_arm_v_m();
  const Quaternion old_q_vb = installation_.q_vb();
  installation_ = Installation(profile, gravity_);
  start_ = installation_.at(*previous_);
  discontinuity_ = discontinuity_ || installation_.lever_arm_v_m() != old_arm_v_m ||
                   installation_.q_vb().coeffs() != old_q_vb.coeffs();
  revisions_.installation = profile.request.journal_number;
}

void ImuModel::take(const FaultProfile& profile, std::uint64_t) {
  gyro_.set_bias_jump(profile.gyro_bias_jump_deg_per_h * units::kDegPerH);
  accel_.set_bias_jump(profile.accel_bias_jump_mgal * units::kMGal);
  revisions_.fault = profile.request.journal_number;
}

std::optional<ImuModel::Output> ImuModel::end_interval(const TruthState& truth) {
  const std::int64_t end_ns = truth.header.sim_time_ns;
  const auto k = static_cast<std::uint64_t>(end_ns / imu_period_ns_ - 1);
  const double dt_s = static_cast<double>(imu_period_ns_) * 1e-9;
  const Increments vibration = vibration_.increments(end_ns - imu_period_ns_, end_ns);

  std::optional<Output> out(std::in_place);  // filled in place: a kilobyte is not worth a copy
  ImuTruth& perfect = out->truth;
  perfect.header = truth.header;
  perfect.header.sequence_number = k;
  perfect.header.publish_realtime_ns = 0;
  perfect.header.publish_monotonic_ns = 0;
  perfect.sensor_number = sensor_number_;
  perfect.dtheta_b = perfect_.dtheta;
  perfect.dv_b = perfect_.dv;
  perfect.interval_ns = imu_period_ns_;
  perfect.latitude_rad = start_.site.position.latitude_rad;  // start_ has become the end of this interval
  perfect.longitude_rad = start_.site.position.longitude_rad;
  perfect.height_m = start_.site.position.height_m;
  perfect.v_n = start_.site.v_n;
  perfect.q_nb = installation_.q_nb(truth, start_);
  perfect.gyro_error = gyro_.errors(perfect_.dtheta, vibration.dtheta, k);
  perfect.accel_error = accel_.errors(perfect_.dv, vibration.dv, k);
  perfect.discontinuity = discontinuity_;
  perfect.revisions = revisions_;
  discontinuity_ = false;

  ImuSample& sample = out->sample;
  sample.header = perfect.header;
  sample.sensor_number = sensor_number_;
  sample.dtheta_b = perfect.dtheta_b + perfect.gyro_error.sum();
  sample.dv_b = perfect.dv_b + perfect.accel_error.sum();
  sample.interval_ns = imu_period_ns_;
  sample.mean_omega_ib_b = sample.dtheta_b / dt_s;
  sample.mean_f_b = sample.dv_b / dt_s;
  sample.revisions = revisions_;
  return out;
}

}  // namespace inslab::imu
