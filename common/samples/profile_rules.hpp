#pragma once

#include <optional>

#include "samples/fault_profile.hpp"
#include "samples/gnss_error_profile.hpp"
#include "samples/imu_error_profile.hpp"
#include "samples/installation_profile.hpp"
#include "samples/vibration_profile.hpp"
#include "samples/violation.hpp"

/// Rules of profiles that span several fields; the limits of single fields stand in their declarations. Each function
/// returns the first rule broken, or nothing.
namespace inslab {
inline namespace samples {

inline constexpr double kMaxLeverArmM = 1000.0;

namespace detail {

inline std::optional<Violation> target_violation(const SensorAddress& target, SensorKind expected) {
  if (target.kind == expected) return std::nullopt;
  return Violation{
      Rule::ProfileFitsSensor, "target_kind",
      "is " + std::string(enum_name(target.kind)) + "; this profile is for " + std::string(enum_name(expected))};
}

inline std::optional<Violation> fade_violation(const ProfileRequest& request) {
  if (request.fade_s == 0.0) return std::nullopt;
  return Violation{Rule::OnlyVibrationFades, "request.fade_s",
                   "is " + std::to_string(request.fade_s) + "; only vibration fades"};
}

inline std::optional<Violation> correlation_violation(const std::string& triad, const char* quantity,
                                                      const Vector3& sigma, const Vector3& correlation_time_s) {
  for (int axis = 0; axis < 3; ++axis) {
    if (sigma[axis] != 0.0 && !(correlation_time_s[axis] > 0.0)) {
      return Violation{Rule::CorrelationTime, triad + ".bias_gm_correlation_time_s[" + std::to_string(axis) + "]",
                       std::string("is not above 0 where ") + quantity + " is"};
    }
  }
  return std::nullopt;
}

inline std::optional<Violation> zero_violation(Rule rule, const char* path, const Vector3& value, const char* reason) {
  if (value.isZero(0.0)) return std::nullopt;
  return Violation{rule, path, reason};
}

}  // namespace detail

inline std::optional<Violation> violation(const ImuErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile.target, SensorKind::Imu)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken =
          detail::correlation_violation("gyro", "bias_gm_sigma_deg_per_h", profile.gyro.bias_gm_sigma_deg_per_h,
                                        profile.gyro.bias_gm_correlation_time_s)) {
    return broken;
  }
  return detail::correlation_violation("accel", "bias_gm_sigma_mgal", profile.accel.bias_gm_sigma_mgal,
                                       profile.accel.bias_gm_correlation_time_s);
}

inline std::optional<Violation> violation(const VibrationProfile& profile) {
  return detail::target_violation(profile.target, SensorKind::Imu);
}

inline std::optional<Violation> violation(const InstallationProfile& profile) {
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (!(profile.lever_arm_v_m.norm() <= kMaxLeverArmM)) {
    return Violation{Rule::LeverArmLength, "lever_arm_v_m",
                     "is " + std::to_string(profile.lever_arm_v_m.norm()) + " m long; a lever arm has at most 1000 m"};
  }
  if (profile.target.kind != SensorKind::Gnss) return std::nullopt;
  return detail::zero_violation(Rule::AntennaMounting, "mounting_rpy_deg", profile.mounting_rpy_deg,
                                "is not 0; an antenna has no axes");
}

inline std::optional<Violation> violation(const GnssErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile.target, SensorKind::Gnss)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (profile.fix_type == FixType::None) {
    return Violation{Rule::FixTypeGiven, "fix_type", "is none; a receiver without a fix is the fault 'outage'"};
  }
  return std::nullopt;
}

inline std::optional<Violation> violation(const FaultProfile& profile) {
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (profile.target.kind == SensorKind::Imu) {
    if (profile.outage)
      return Violation{Rule::FaultFitsSensor, "outage", "is true; an outage is a fault of a gnss receiver"};
    return detail::zero_violation(Rule::FaultFitsSensor, "position_jump_ned_m", profile.position_jump_ned_m,
                                  "is not 0; a position jump is a fault of a gnss receiver");
  }
  if (auto broken =
          detail::zero_violation(Rule::FaultFitsSensor, "gyro_bias_jump_deg_per_h", profile.gyro_bias_jump_deg_per_h,
                                 "is not 0; a bias jump is a fault of an imu")) {
    return broken;
  }
  return detail::zero_violation(Rule::FaultFitsSensor, "accel_bias_jump_mgal", profile.accel_bias_jump_mgal,
                                "is not 0; a bias jump is a fault of an imu");
}

}  // namespace samples
}  // namespace inslab
