#include "inslab/referee/calibrate/static_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inslab/nav/geodesy.hpp"

namespace inslab::calibrate {
namespace {

nav::Vector3 angles(const nav::RollPitchYaw& rpy) { return {rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad}; }

/// Nothing but the pole is refused.
nav::AlignmentLimits for_short_spans(nav::AlignmentLimits limits) {
  limits.rate_ratio = limits.force_spread_m_per_s2 = limits.force_from_gravity_m_per_s2 =
      std::numeric_limits<double>::infinity();
  return limits;
}

}  // namespace

StaticAlignment::StaticAlignment(double dt_s, double latitude_rad, double gravity_m_per_s2,
                                 const nav::AlignmentLimits& limits, std::optional<double> gyro_bias_rad_per_s)
    : dt_s_(dt_s),
      latitude_rad_(latitude_rad),
      gravity_m_per_s2_(gravity_m_per_s2),
      limits_(limits),
      gyro_bias_rad_per_s_(gyro_bias_rad_per_s) {
  if (!(dt_s > 0.0)) throw std::invalid_argument("an IMU interval must be longer than 0 s");
  samples_per_second_ = static_cast<std::uint64_t>(std::max(1.0, std::round(1.0 / dt_s)));
}

std::optional<nav::RollPitchYaw> StaticAlignment::solve(const nav::Vector3& dtheta_b, const nav::Vector3& dv_b,
                                                        double span_s) const {
  nav::StaticMeans means;
  means.f_b = dv_b / span_s;
  means.omega_ib_b = dtheta_b / span_s;
  const auto result = nav::coarse_alignment(means, latitude_rad_, gravity_m_per_s2_, for_short_spans(limits_));
  const auto* C_nb = std::get_if<nav::Matrix3>(&result);
  if (C_nb == nullptr) return std::nullopt;
  return nav::rpy_from_matrix(*C_nb);
}

void StaticAlignment::add(const nav::Vector3& dtheta_b, const nav::Vector3& dv_b) {
  const nav::Vector3 f_b = dv_b / dt_s_;
  if (samples_ == 0) f_first_ = f_b;
  f_sum_ += f_b - f_first_;
  f_squares_ += (f_b - f_first_).cwiseAbs2();
  dtheta_sum_ += dtheta_b;
  dv_sum_ += dv_b;
  second_dtheta_ += dtheta_b;
  second_dv_ += dv_b;
  ++samples_;
  if (const auto rpy = solve(dtheta_b, dv_b, dt_s_)) {
    if (reference_rad_) {
      add_to(epochs_, *rpy);
    } else {
      waiting_.push_back(*rpy);
    }
  }
  if (samples_ % samples_per_second_ == 0) end_second();
}

void StaticAlignment::end_second() {
  const double span_s = static_cast<double>(samples_per_second_) * dt_s_;
  const auto rpy = solve(second_dtheta_, second_dv_, span_s);
  seconds_means_.push_back({second_dtheta_ / span_s, second_dv_ / span_s});
  second_dtheta_.setZero();
  second_dv_.setZero();
  if (!rpy) return;
  if (!reference_rad_) {
    reference_rad_ = angles(*rpy);
    for (const nav::RollPitchYaw& one : waiting_) add_to(epochs_, one);
    waiting_.clear();
  }
  add_to(seconds_, *rpy);
  each_second_.push_back(*rpy);
}

void StaticAlignment::add_to(Sums& sums, const nav::RollPitchYaw& rpy) const {
  nav::Vector3 off = angles(rpy) - *reference_rad_;
  for (double& angle : off) angle = nav::wrapped_to_pi(angle);
  ++sums.count;
  sums.sum += off;
  sums.squares += off.cwiseAbs2();
}

Spread StaticAlignment::spread_of(const Sums& sums) const {
  Spread spread;
  spread.count = sums.count;
  if (sums.count < 2) return spread;
  const double n = static_cast<double>(sums.count);
  const nav::Vector3 mean = sums.sum / n;
  spread.mean_rad = *reference_rad_ + mean;
  spread.sigma_rad = ((sums.squares - n * mean.cwiseAbs2()) / (n - 1.0)).cwiseMax(0.0).cwiseSqrt();
  return spread;
}

AlignmentResult StaticAlignment::result() const {
  AlignmentResult result;
  result.samples = samples_;
  result.epochs = spread_of(epochs_);
  result.seconds = spread_of(seconds_);
  result.each_second = each_second_;
  if (samples_ < samples_per_second_ || samples_ < 2) {
    result.refusal = "the recording is shorter than a second";
    return result;
  }
  const double n = static_cast<double>(samples_), span_s = n * dt_s_;
  nav::StaticMeans means;
  means.f_b = dv_sum_ / span_s;
  means.omega_ib_b = dtheta_sum_ / span_s;
  means.f_spread_b = ((f_squares_ - f_sum_.cwiseAbs2() / n) / (n - 1.0)).cwiseMax(0.0).cwiseSqrt();
  align_whole(means, result);
  return result;
}

void StaticAlignment::align_whole(nav::StaticMeans means, AlignmentResult& result) const {
  result.tilt = tilt_trend(seconds_means_, static_cast<double>(samples_per_second_) * dt_s_);
  const bool tilts = result.tilt && result.tilt->shows();
  if (tilts) {
    const auto with_tilt = nav::coarse_alignment(means, latitude_rad_, gravity_m_per_s2_, for_short_spans(limits_));
    if (const auto* C_nb = std::get_if<nav::Matrix3>(&with_tilt)) {
      result.yaw_with_tilt_rad = nav::rpy_from_matrix(*C_nb).yaw_rad;
    }
    means.omega_ib_b = result.tilt->omega_ie_b;
  }
  const auto whole = nav::coarse_alignment(means, latitude_rad_, gravity_m_per_s2_, limits_);
  if (const auto* reason = std::get_if<std::string>(&whole)) result.refusal = *reason;
  const auto* C_nb = std::get_if<nav::Matrix3>(&whole);
  if (C_nb == nullptr) return;
  result.whole = nav::rpy_from_matrix(*C_nb);
  if (result.tilt) result.tilt_rate_n = *C_nb * result.tilt->omega_nb_b;
  result.yaw = yaw_uncertainty(means.omega_ib_b, C_nb->row(2).transpose(), latitude_rad_, seconds_means_,
                               tilts ? result.tilt : std::nullopt, gyro_bias_rad_per_s_);
}

}  // namespace inslab::calibrate
