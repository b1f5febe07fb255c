#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "inslab/data/catalog/air_data_rules.hpp"
#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/catalog/correlation_rule.hpp"
#include "inslab/data/catalog/fault_rules.hpp"
#include "inslab/data/catalog/receiver_rules.hpp"
#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/foundation/units/units.hpp"

/// Rules of profiles that span several fields; the limits of single fields stand in their declarations. Each function
/// returns the first rule broken, or nothing.
namespace inslab::catalog {

inline constexpr double kMaxLeverArmM = 1000.0;
inline constexpr double kMinBaselineM = 0.1;
inline constexpr double kMaxMotionM = 0.05;     ///< of a mount against the vehicle
inline constexpr double kMaxMotionDeg = 2.0;    ///< the same
inline constexpr double kMaxMotionHz = 2000.0;  ///< the same

namespace detail {

template <class Profile>
std::optional<Violation> target_violation(const Profile& profile) {
  if (takes_profile(profile.target.kind, Profile::kind)) return std::nullopt;
  return Violation{
      Rule::ProfileFitsSensor, "target_kind",
      "is " + std::string(enum_name(profile.target.kind)) + "; this profile is for " + wearers(Profile::kind)};
}

inline std::optional<Violation> fade_violation(const ProfileRequest& request) {
  if (request.fade_s == 0.0) return std::nullopt;
  return Violation{Rule::OnlyVibrationFades, "request.fade_s",
                   "is " + std::to_string(request.fade_s) + "; only vibration fades"};
}

inline std::optional<Violation> nonlinearity_violation(const std::string& path, const char* full_scale_name,
                                                       const Vector3& nonlinearity, const Vector3& full_scale) {
  for (int axis = 0; axis < 3; ++axis) {
    if (nonlinearity[axis] != 0.0 && full_scale[axis] == 0.0) {
      return Violation{Rule::NonlinearityScale, element(path, axis),
                       std::string("is given without ") + full_scale_name + ", of which it is a part"};
    }
  }
  return std::nullopt;
}

inline std::optional<Violation> gyro_violation(const GyroErrors& gyro) {
  if (auto broken = correlation_violation("gyro.bias_gm_correlation_time_s", "bias_gm_sigma_deg_per_h",
                                          gyro.bias_gm_sigma_deg_per_h, gyro.bias_gm_correlation_time_s)) {
    return broken;
  }
  if (auto broken = correlation_violation("gyro.scale_factor_gm_correlation_time_s", "scale_factor_gm_sigma_ppm",
                                          gyro.scale_factor_gm_sigma_ppm, gyro.scale_factor_gm_correlation_time_s)) {
    return broken;
  }
  return nonlinearity_violation("gyro.nonlinearity_ppm_of_full_scale", "full_scale_deg_per_s",
                                gyro.nonlinearity_ppm_of_full_scale, gyro.full_scale_deg_per_s);
}

inline std::optional<Violation> cross_axis_violation(const ImuErrorProfile& profile) {
  if (auto broken = correlation_violation("gyro_cross_axis_gm_correlation_time_s", "gyro_cross_axis_gm_sigma_arcsec",
                                          profile.gyro_cross_axis_gm_sigma_arcsec,
                                          profile.gyro_cross_axis_gm_correlation_time_s)) {
    return broken;
  }
  return correlation_violation("accel_cross_axis_gm_correlation_time_s", "accel_cross_axis_gm_sigma_arcsec",
                               profile.accel_cross_axis_gm_sigma_arcsec,
                               profile.accel_cross_axis_gm_correlation_time_s);
}

inline std::optional<Violation> accel_violation(const AccelErrors& accel) {
  if (auto broken = correlation_violation("accel.bias_gm_correlation_time_s", "bias_gm_sigma_mgal",
                                          accel.bias_gm_sigma_mgal, accel.bias_gm_correlation_time_s)) {
    return broken;
  }
  if (auto broken = correlation_violation("accel.scale_factor_gm_correlation_time_s", "scale_factor_gm_sigma_ppm",
                                          accel.scale_factor_gm_sigma_ppm, accel.scale_factor_gm_correlation_time_s)) {
    return broken;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (accel.full_scale_g[axis] != 0.0 && accel.full_scale_g[axis] < 1.0) {
      return Violation{Rule::FullScale, element("accel.full_scale_g", axis),
                       "is " + number_text(accel.full_scale_g[axis]) +
                           "; an accelerometer reads at least its own weight, 1 g (0: no limit)"};
    }
  }
  return nonlinearity_violation("accel.nonlinearity_ppm_of_full_scale", "full_scale_g",
                                accel.nonlinearity_ppm_of_full_scale, accel.full_scale_g);
}

/// Corners of a course over time.
template <class Corner>
std::optional<Violation> in_order_violation(const std::string& path, const std::vector<Corner>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].at_s > points[i - 1].at_s)) {
      return Violation{Rule::CornersInOrder, path + "[" + std::to_string(i) + "].at_s",
                       "is " + number_text(points[i].at_s) + "; expected later than the one before, " +
                           number_text(points[i - 1].at_s)};
    }
  }
  return std::nullopt;
}

/// Of the clock that every kind of sensor has.
inline std::optional<Violation> time_tag_violation(const TimeTagErrors& clock) {
  if (auto broken = correlation_violation("time_tag.gm_correlation_time_s", "gm_sigma_s", clock.gm_sigma_s,
                                          clock.gm_correlation_time_s)) {
    return broken;
  }
  return in_order_violation("time_tag.steps", clock.steps);
}

template <class Point>
std::optional<Violation> random_table_violation(const std::string& path, const std::vector<Point>& points) {
  if (points.size() == 1) {
    return Violation{Rule::RandomTable, path, "has one element; expected at least two, which span a band"};
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].frequency_hz > points[i - 1].frequency_hz)) {
      return Violation{Rule::RandomTable, path + "[" + std::to_string(i) + "].frequency_hz",
                       "is " + number_text(points[i].frequency_hz) + "; expected above the one before, " +
                           number_text(points[i - 1].frequency_hz)};
    }
  }
  return std::nullopt;
}

/// `reach(sinusoid)` is the largest excursion that one sinusoid can make, in the unit of `limit`.
template <class Sinusoid, class Reach>
std::optional<Violation> motion_violation(const std::string& path, const std::vector<Sinusoid>& sinusoids,
                                          const Reach& reach, double limit, const char* unit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sinusoids.size(); ++i) {
    if (!(sinusoids[i].frequency_hz <= kMaxMotionHz)) {
      return Violation{Rule::MotionFrequency, path + "[" + std::to_string(i) + "].frequency_hz",
                       "is " + number_text(sinusoids[i].frequency_hz) + "; a mount moves at up to " +
                           number_text(kMaxMotionHz) + " Hz"};
    }
    sum += reach(sinusoids[i]);
  }
  if (sum <= limit) return std::nullopt;
  return Violation{Rule::MotionReach, path,
                   "reaches " + number_text(sum) + " " + unit + "; a mount moves by at most " + number_text(limit)};
}

inline std::optional<Violation> mount_violation(const VibrationProfile& profile) {
  const auto omega = [](double frequency_hz) { return 2.0 * units::kPi * frequency_hz; };
  const auto displacement_m = [&omega](const LinearSinusoid& sinusoid) {
    const double w = omega(sinusoid.frequency_hz);
    return sinusoid.amplitude_m_per_s2.norm() / (w * w);
  };
  const auto turn_deg = [&omega](const AngularSinusoid& sinusoid) {
    return sinusoid.amplitude_deg_per_s.norm() / omega(sinusoid.frequency_hz);
  };
  if (auto broken = motion_violation("linear", profile.linear, displacement_m, kMaxMotionM, "m")) return broken;
  if (auto broken = motion_violation("angular", profile.angular, turn_deg, kMaxMotionDeg, "deg")) return broken;
  constexpr const char* kReason = "is given; random vibration is for the domain 'sensor'";
  if (!profile.linear_random.empty()) return Violation{Rule::MotionHarmonic, "linear_random", kReason};
  if (!profile.angular_random.empty()) return Violation{Rule::MotionHarmonic, "angular_random", kReason};
  return std::nullopt;
}

/// Of what names a recording by file and SHA-256.
template <class Recorded>
std::optional<Violation> recording_violation(const Recorded& recorded) {
  if (recorded.file.empty() && recorded.sha256.empty()) return std::nullopt;
  if (recorded.file.empty()) return Violation{Rule::RecordingNamed, "recorded_error.file", "is missing"};
  if (recorded.file.find('/') != std::string::npos) {
    return Violation{Rule::RecordingNamed, "recorded_error.file",
                     "is a path; expected the name of a file in the folder of recordings"};
  }
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (recorded.sha256.size() == 64 && std::all_of(recorded.sha256.begin(), recorded.sha256.end(), is_digit)) {
    return std::nullopt;
  }
  return Violation{Rule::RecordingNamed, "recorded_error.sha256",
                   "is no SHA-256; expected the 64 digits that sha256sum prints"};
}

inline std::optional<Violation> zero_violation(Rule rule, const char* path, const Vector3& value, const char* reason) {
  if (value.isZero(0.0)) return std::nullopt;
  return Violation{rule, path, reason};
}

}  // namespace detail

inline std::optional<Violation> violation(const ImuErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::gyro_violation(profile.gyro)) return broken;
  if (auto broken = detail::accel_violation(profile.accel)) return broken;
  if (auto broken = detail::cross_axis_violation(profile)) return broken;
  if (auto broken = detail::recording_violation(profile.recorded_error)) return broken;
  return detail::in_order_violation("temperature", profile.temperature);
}

inline std::optional<Violation> violation(const VibrationProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::random_table_violation("linear_random", profile.linear_random)) return broken;
  if (auto broken = detail::random_table_violation("angular_random", profile.angular_random)) return broken;
  return profile.domain == VibrationDomain::Motion ? detail::mount_violation(profile) : std::nullopt;
}

namespace detail {

inline std::optional<Violation> arm_violation(const char* path, const Vector3& arm_v_m) {
  if (arm_v_m.norm() <= kMaxLeverArmM) return std::nullopt;
  return Violation{Rule::LeverArmLength, path,
                   "is " + std::to_string(arm_v_m.norm()) + " m long; a lever arm has at most 1000 m"};
}

inline std::optional<Violation> baseline_violation(const InstallationProfile& profile) {
  if (profile.target.kind != SensorKind::Heading) {
    return zero_violation(Rule::BaselineLength, "second_lever_arm_v_m", profile.second_lever_arm_v_m,
                          "is not 0; a two-antenna heading alone has a second arm");
  }
  const double length_m = (profile.second_lever_arm_v_m - profile.lever_arm_v_m).norm();
  if (length_m >= kMinBaselineM) return std::nullopt;
  return Violation{Rule::BaselineLength, "second_lever_arm_v_m",
                   "is " + number_text(length_m) + " m from lever_arm_v_m; two antennas stand at least " +
                       number_text(kMinBaselineM) + " m apart"};
}

}  // namespace detail

inline std::optional<Violation> violation(const InstallationProfile& profile) {
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::arm_violation("lever_arm_v_m", profile.lever_arm_v_m)) return broken;
  if (auto broken = detail::arm_violation("second_lever_arm_v_m", profile.second_lever_arm_v_m)) return broken;
  if (auto broken = detail::baseline_violation(profile)) return broken;
  if (has_axes(profile.target.kind)) return std::nullopt;
  return detail::zero_violation(
      Rule::AntennaMounting, "mounting_rpy_deg", profile.mounting_rpy_deg,
      profile.target.kind == SensorKind::Gnss ? "is not 0; an antenna has no axes" : "is not 0; it has no axes");
}

inline std::optional<Violation> violation(const GnssErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::fix_type_violation(profile)) return broken;
  if (auto broken = detail::solution_violation("", profile)) return broken;
  if (auto broken = detail::recording_violation(profile.recorded_error)) return broken;
  return detail::ladder_violation(profile);
}

inline std::optional<Violation> violation(const FaultProfile& profile) {
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  return fault_violation(profile);
}

inline std::optional<Violation> violation(const MagnetometerErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::correlation_violation("gm_correlation_time_s", "gm_sigma_nt", profile.gm_sigma_nt,
                                                  profile.gm_correlation_time_s)) {
    return broken;
  }
  return detail::in_order_violation("currents", profile.currents);
}

inline std::optional<Violation> violation(const BarometerErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::correlation_violation(
          "sea_level_pressure_gm_correlation_time_s", "sea_level_pressure_gm_sigma_pa",
          profile.sea_level_pressure_gm_sigma_pa, profile.sea_level_pressure_gm_correlation_time_s)) {
    return broken;
  }
  if (auto broken = detail::correlation_violation(
          "temperature_deviation_gm_correlation_time_s", "temperature_deviation_gm_sigma_deg_c",
          profile.temperature_deviation_gm_sigma_deg_c, profile.temperature_deviation_gm_correlation_time_s)) {
    return broken;
  }
  if (auto broken = detail::correlation_violation("gm_correlation_time_s", "gm_sigma_pa", profile.gm_sigma_pa,
                                                  profile.gm_correlation_time_s)) {
    return broken;
  }
  if (profile.max_pressure_pa == 0.0 || profile.max_pressure_pa > profile.min_pressure_pa) return std::nullopt;
  return Violation{Rule::PressureRange, "max_pressure_pa",
                   "is " + number_text(profile.max_pressure_pa) + "; expected above min_pressure_pa, " +
                       number_text(profile.min_pressure_pa) + " (0: no limit)"};
}

inline std::optional<Violation> violation(const OdometerErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::correlation_violation("scale_factor_gm_correlation_time_s", "scale_factor_gm_sigma_ppm",
                                                  profile.scale_factor_gm_sigma_ppm,
                                                  profile.scale_factor_gm_correlation_time_s)) {
    return broken;
  }
  if (profile.counts_per_revolution == std::floor(profile.counts_per_revolution)) return std::nullopt;
  return Violation{Rule::WholeCounts, "counts_per_revolution",
                   "is " + number_text(profile.counts_per_revolution) + "; expected a whole number"};
}

inline std::optional<Violation> violation(const HeadingErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  if (auto broken = detail::fix_type_violation(profile)) return broken;
  if (auto broken = detail::solution_violation("", profile)) return broken;
  return detail::ladder_violation(profile);
}

inline std::optional<Violation> violation(const AirDataErrorProfile& profile) {
  if (auto broken = detail::target_violation(profile)) return broken;
  if (auto broken = detail::fade_violation(profile.request)) return broken;
  if (auto broken = detail::time_tag_violation(profile.time_tag)) return broken;
  return detail::air_data_violation(profile);
}

/// The first limit or rule that a profile of any kind breaks.
inline std::optional<Violation> broken_rule(const AnyProfile& profile) {
  return std::visit(
      [](const auto& one) {
        auto limits = limit_violation(one);
        return limits ? limits : violation(one);
      },
      profile);
}

}  // namespace inslab::catalog
