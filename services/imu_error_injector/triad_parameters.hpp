#pragma once

#include "samples/imu_error_profile.hpp"
#include "samples/units.hpp"

namespace inslab::imu {

/// Errors of one triad in SI: rad and rad/s for gyros, m/s and m/s^2 for accelerometers.
struct TriadParameters {
  Vector3 bias_constant = Vector3::Zero();       ///< rad/s | m/s^2
  Vector3 bias_turn_on_sigma = Vector3::Zero();  ///< rad/s | m/s^2
  Vector3 bias_gm_sigma = Vector3::Zero();       ///< rad/s | m/s^2
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 random_walk = Vector3::Zero();   ///< rad/sqrt(s) | m/s/sqrt(s)
  Vector3 scale_factor = Vector3::Zero();  ///< 1
  Vector6 cross_axis_rad = Vector6::Zero();
};

inline TriadParameters in_si(const GyroErrors& gyro) {
  return {gyro.bias_constant_deg_per_h * units::kDegPerH, gyro.bias_turn_on_sigma_deg_per_h * units::kDegPerH,
          gyro.bias_gm_sigma_deg_per_h * units::kDegPerH, gyro.bias_gm_correlation_time_s,
          gyro.arw_deg_per_sqrt_h * units::kDegPerSqrtH,  gyro.scale_factor_ppm * units::kPpm,
          gyro.cross_axis_arcsec * units::kArcsec};
}

inline TriadParameters in_si(const AccelErrors& accel) {
  return {accel.bias_constant_mgal * units::kMGal,
          accel.bias_turn_on_sigma_mgal * units::kMGal,
          accel.bias_gm_sigma_mgal * units::kMGal,
          accel.bias_gm_correlation_time_s,
          accel.vrw_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH,
          accel.scale_factor_ppm * units::kPpm,
          accel.cross_axis_arcsec * units::kArcsec};
}

}  // namespace inslab::imu
