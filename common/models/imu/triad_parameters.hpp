#pragma once

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {

/// Errors of one triad in SI: rad and rad/s for gyros, m/s and m/s^2 for accelerometers.
struct TriadParameters {
  Vector3 bias_constant = Vector3::Zero();       ///< rad/s | m/s^2
  Vector3 bias_turn_on_sigma = Vector3::Zero();  ///< rad/s | m/s^2
  Vector3 bias_gm_sigma = Vector3::Zero();       ///< rad/s | m/s^2
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 bias_random_walk = Vector3::Zero();  ///< rad/s/sqrt(s) | m/s^2/sqrt(s)
  Vector3 bias_instability = Vector3::Zero();  ///< rad/s | m/s^2
  Vector3 bias_per_deg_c = Vector3::Zero();    ///< rad/s/K | m/s^2/K
  Vector3 bias_per_warming = Vector3::Zero();  ///< rad/s | m/s^2 per K/s
  Vector3 bias_hysteresis = Vector3::Zero();   ///< rad/s | m/s^2, of rising less that of falling temperatures
  double bias_hysteresis_width_k = 1.0;
  Vector3 random_walk = Vector3::Zero();   ///< rad/sqrt(s) | m/s/sqrt(s)
  Vector3 scale_factor = Vector3::Zero();  ///< 1
  Vector3 scale_factor_turn_on_sigma = Vector3::Zero();
  Vector3 scale_factor_gm_sigma = Vector3::Zero();
  Vector3 scale_factor_gm_correlation_time_s = Vector3::Zero();
  Vector3 scale_factor_per_deg_c = Vector3::Zero();      ///< 1/K
  Vector3 scale_factor_asymmetry = Vector3::Zero();      ///< 1
  Vector3 nonlinearity_of_full_scale = Vector3::Zero();  ///< 1
  Vector3 nonlinearity_by_input = Vector3::Zero();       ///< 1/(rad/s) | 1/(m/s^2)
  Vector6 cross_axis_rad = Vector6::Zero();
  Vector6 cross_axis_gm_sigma_rad = Vector6::Zero();
  Vector6 cross_axis_gm_correlation_time_s = Vector6::Zero();
  Vector3 bandwidth_hz = Vector3::Zero();
  FilterOrder bandwidth_order = FilterOrder::First;
  Vector3 full_scale = Vector3::Zero();    ///< rad/s | m/s^2; 0: no limit
  Vector3 quantization = Vector3::Zero();  ///< rad | m/s; 0: none
};

/// What gyros and accelerometers name alike.
template <class Errors>
TriadParameters common_in_si(const Errors& errors) {
  TriadParameters si;
  si.bias_gm_correlation_time_s = errors.bias_gm_correlation_time_s;
  si.scale_factor = errors.scale_factor_ppm * units::kPpm;
  si.scale_factor_turn_on_sigma = errors.scale_factor_turn_on_sigma_ppm * units::kPpm;
  si.scale_factor_gm_sigma = errors.scale_factor_gm_sigma_ppm * units::kPpm;
  si.scale_factor_gm_correlation_time_s = errors.scale_factor_gm_correlation_time_s;
  si.scale_factor_per_deg_c = errors.scale_factor_temperature_ppm_per_deg_c * units::kPpm;
  si.scale_factor_asymmetry = errors.scale_factor_asymmetry_ppm * units::kPpm;
  si.nonlinearity_of_full_scale = errors.nonlinearity_ppm_of_full_scale * units::kPpm;
  si.cross_axis_rad = errors.cross_axis_arcsec * units::kArcsec;
  si.bandwidth_hz = errors.bandwidth_hz;
  si.bandwidth_order = errors.bandwidth_order;
  return si;
}

inline TriadParameters in_si(const GyroErrors& gyro) {
  TriadParameters si = common_in_si(gyro);
  si.bias_constant = gyro.bias_constant_deg_per_h * units::kDegPerH;
  si.bias_turn_on_sigma = gyro.bias_turn_on_sigma_deg_per_h * units::kDegPerH;
  si.bias_gm_sigma = gyro.bias_gm_sigma_deg_per_h * units::kDegPerH;
  si.bias_random_walk = gyro.bias_random_walk_deg_per_h_per_sqrt_h * units::kDegPerHPerSqrtH;
  si.bias_instability = gyro.bias_instability_deg_per_h * units::kDegPerH;
  si.bias_per_deg_c = gyro.bias_temperature_deg_per_h_per_deg_c * units::kDegPerH;
  si.random_walk = gyro.arw_deg_per_sqrt_h * units::kDegPerSqrtH;
  si.full_scale = gyro.full_scale_deg_per_s * units::kDegPerS;
  si.quantization = gyro.quantization_arcsec * units::kArcsec;
  return si;
}

inline TriadParameters in_si(const AccelErrors& accel) {
  TriadParameters si = common_in_si(accel);
  si.bias_constant = accel.bias_constant_mgal * units::kMGal;
  si.bias_turn_on_sigma = accel.bias_turn_on_sigma_mgal * units::kMGal;
  si.bias_gm_sigma = accel.bias_gm_sigma_mgal * units::kMGal;
  si.bias_random_walk = accel.bias_random_walk_mgal_per_sqrt_h * units::kMGalPerSqrtH;
  si.bias_instability = accel.bias_instability_mgal * units::kMGal;
  si.bias_per_deg_c = accel.bias_temperature_mgal_per_deg_c * units::kMGal;
  si.random_walk = accel.vrw_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH;
  si.nonlinearity_by_input = accel.nonlinearity_ppm_per_g * (units::kPpm / units::kG);
  si.full_scale = accel.full_scale_g * units::kG;
  si.quantization = accel.quantization_m_per_s;
  return si;
}

/// With what stands beside its triads in a profile.
inline TriadParameters gyros_in_si(const ImuErrorProfile& profile) {
  TriadParameters si = in_si(profile.gyro);
  si.cross_axis_gm_sigma_rad = profile.gyro_cross_axis_gm_sigma_arcsec * units::kArcsec;
  si.cross_axis_gm_correlation_time_s = profile.gyro_cross_axis_gm_correlation_time_s;
  si.bias_per_warming = profile.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min * (60.0 * units::kDegPerH);
  si.bias_hysteresis = profile.gyro_bias_hysteresis_deg_per_h * units::kDegPerH;
  si.bias_hysteresis_width_k = profile.bias_hysteresis_width_deg_c;
  return si;
}
inline TriadParameters accels_in_si(const ImuErrorProfile& profile) {
  TriadParameters si = in_si(profile.accel);
  si.cross_axis_gm_sigma_rad = profile.accel_cross_axis_gm_sigma_arcsec * units::kArcsec;
  si.cross_axis_gm_correlation_time_s = profile.accel_cross_axis_gm_correlation_time_s;
  si.bias_per_warming = profile.accel_bias_temperature_rate_mgal_per_deg_c_per_min * (60.0 * units::kMGal);
  si.bias_hysteresis = profile.accel_bias_hysteresis_mgal * units::kMGal;
  si.bias_hysteresis_width_k = profile.bias_hysteresis_width_deg_c;
  return si;
}

}  // namespace inslab::imu
