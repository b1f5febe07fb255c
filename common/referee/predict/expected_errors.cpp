#include "inslab/referee/predict/expected_errors.hpp"

#include <algorithm>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/temperature.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/referee/predict/predict_uses.hpp"

namespace inslab::predict {
namespace {

/// The errors of the rung that a fix comes from: its fix type's, the nearest in size where two share a type. A fix that
/// no rung explains counts with the sigmas that it reports.
SolutionErrors errors_of(const GnssErrorProfile& profile, const GnssFix& fix) {
  std::vector<SolutionErrors> rungs;
  if (profile.fix_type == fix.fix_type) rungs.push_back(profile);
  for (const LesserSolution& lesser : profile.lesser_solutions) {
    if (lesser.fix_type == fix.fix_type) rungs.push_back(lesser);
  }
  const auto off = [&fix](const SolutionErrors& rung) {
    return (rung.position_total_sigma_ned_m() - fix.position_sigma_ned_m).norm();
  };
  if (!rungs.empty()) {
    return *std::min_element(rungs.begin(), rungs.end(),
                             [&](const SolutionErrors& a, const SolutionErrors& b) { return off(a) < off(b); });
  }
  SolutionErrors reported;
  reported.position_sigma_ned_m = fix.position_sigma_ned_m;
  reported.velocity_sigma_ned_m_per_s = fix.velocity_sigma_ned_m_per_s;
  return reported;
}

std::vector<std::string> names_left_out(const catalog::AnyProfile& profile) {
  const auto* vibration = std::get_if<VibrationProfile>(&profile);
  if (vibration != nullptr && vibration->domain == VibrationDomain::Motion) return {};  // part of the true motion
  return std::visit(
      [](const auto& one) { return profiles::names_left_out(uses_of(Tag<std::decay_t<decltype(one)>>{}), one); },
      profile);
}

}  // namespace

ExpectedErrors::ExpectedErrors(const Setup& setup, std::vector<catalog::AnyProfile> profiles)
    : setup_(setup), imu_{SensorKind::Imu, setup.imu_number}, profiles_(std::move(profiles)) {
  if (setup.gnss_number) gnss_ = SensorAddress{SensorKind::Gnss, *setup.gnss_number};
  std::stable_sort(profiles_.begin(), profiles_.end(), [](const catalog::AnyProfile& a, const catalog::AnyProfile& b) {
    return catalog::request_of(a).apply_at_ns < catalog::request_of(b).apply_at_ns;
  });
}

/// Those that samples of this time are made under and that have not been taken yet.
void ExpectedErrors::use_profiles(std::int64_t sim_time_ns) {
  for (; next_ < profiles_.size() && catalog::request_of(profiles_[next_]).apply_at_ns < sim_time_ns; ++next_) {
    const catalog::AnyProfile& profile = profiles_[next_];
    const bool of_imu = catalog::target_of(profile) == imu_, of_gnss = gnss_ && catalog::target_of(profile) == *gnss_;
    if (const auto* errors = std::get_if<ImuErrorProfile>(&profile); errors != nullptr && of_imu) {
      errors_ = *errors;
      if (growth_) growth_->swap(errors_);
    } else if (const auto* solution = std::get_if<GnssErrorProfile>(&profile); solution != nullptr && of_gnss) {
      fix_errors_ = *solution;
    } else if (const auto* place = std::get_if<InstallationProfile>(&profile); place != nullptr) {
      if (of_imu) imu_place_ = *place;
      if (of_gnss) antenna_place_ = *place;
    }
  }
}

void ExpectedErrors::add(const ImuTruth& truth) {
  if (truth.sensor_number != imu_.number) return;
  const std::int64_t time_ns = truth.header.sim_time_ns;
  use_profiles(time_ns);
  if (time::to_seconds(time_ns) <= setup_.start.time_s) return;
  if (!growth_) {
    growth_.emplace(errors_, setup_.start, setup_.gravity, setup_.vertical, setup_.step_s, setup_.gravity_errors);
    curve_.push_back(growth_->current());
  }
  const imu::Temperature temperature(errors_.temperature);
  const double warmer_k = temperature.at(time_ns) - imu::Temperature::kCalibratedAt;
  const double warmed_k = temperature.at(time_ns) - temperature.at(time_ns - truth.interval_ns);
  const double warming_k_per_s = warmed_k / time::to_seconds(truth.interval_ns);
  if (growth_->advance(truth, warmer_k, warming_k_per_s)) curve_.push_back(growth_->current());
}

void ExpectedErrors::add(const GnssFix& fix) {
  if (!gnss_ || fix.sensor_number != gnss_->number || fix.fix_type == FixType::None || !growth_) return;
  growth_->measure(errors_of(fix_errors_, fix), lever_arm_b_m());
  const PredictedError now = growth_->current();
  if (!curve_.empty() && curve_.back().time_s == now.time_s) {
    curve_.back() = now;
  } else {
    curve_.push_back(now);
  }
}

Vector3 ExpectedErrors::lever_arm_b_m() const {
  const Vector3 rpy_rad = units::kDeg * imu_place_.mounting_rpy_deg;
  const nav::Matrix3 C_vb = nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()});
  return C_vb.transpose() * (antenna_place_.lever_arm_v_m - imu_place_.lever_arm_v_m);
}

std::vector<std::string> ExpectedErrors::left_out() const {
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (setup_.gravity.is_disturbed() && !setup_.gravity_errors) add("gravity disturbance");
  for (const catalog::AnyProfile& profile : profiles_) {
    const bool of_imu = catalog::target_of(profile) == imu_;
    if (!of_imu && !(gnss_ && catalog::target_of(profile) == *gnss_)) continue;
    for (const std::string& name : names_left_out(profile)) add(name);
  }
  return names;
}

}  // namespace inslab::predict
