#pragma once

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/profiles/profile_uses.hpp"

/// What the evidence of a swap weighs of each field of the swapped profile; SwapEvidence::left_out shows the rest.
namespace inslab::cli::evidence {

inline constexpr profiles::FieldUse kImuErrorUses[] = {
    profiles::left_out("gyro.bias_constant_deg_per_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_turn_on_sigma_deg_per_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_gm_sigma_deg_per_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_gm_correlation_time_s", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_random_walk_deg_per_h_per_sqrt_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_instability_deg_per_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("gyro.bias_temperature_deg_per_h_per_deg_c", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::handled("gyro.arw_deg_per_sqrt_h"),
    profiles::left_out("gyro.scale_factor_ppm", "scale factors", "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.scale_factor_turn_on_sigma_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.scale_factor_gm_sigma_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.scale_factor_gm_correlation_time_s", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.scale_factor_temperature_ppm_per_deg_c", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.scale_factor_asymmetry_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.nonlinearity_ppm_of_full_scale", "non-linearity",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.cross_axis_arcsec", "cross-axis angles",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("gyro.g_sensitivity_deg_per_h_per_g", "g-sensitivity",
                       "comes with the motion, whose effect is not weighed"),
    profiles::handled("gyro.bandwidth_hz"),
    profiles::handled("gyro.bandwidth_order"),
    profiles::left_out("gyro.full_scale_deg_per_s", "full scale", "saturated samples are passed over"),
    profiles::handled("gyro.quantization_arcsec"),
    profiles::left_out("accel.bias_constant_mgal", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_turn_on_sigma_mgal", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_gm_sigma_mgal", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_gm_correlation_time_s", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_random_walk_mgal_per_sqrt_h", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_instability_mgal", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("accel.bias_temperature_mgal_per_deg_c", "biases",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::handled("accel.vrw_m_per_s_per_sqrt_h"),
    profiles::left_out("accel.scale_factor_ppm", "scale factors", "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.scale_factor_turn_on_sigma_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.scale_factor_gm_sigma_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.scale_factor_gm_correlation_time_s", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.scale_factor_temperature_ppm_per_deg_c", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.scale_factor_asymmetry_ppm", "scale factors",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.nonlinearity_ppm_of_full_scale", "non-linearity",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.nonlinearity_ppm_per_g", "non-linearity",
                       "comes with the motion, whose effect is not weighed"),
    profiles::left_out("accel.cross_axis_arcsec", "cross-axis angles",
                       "comes with the motion, whose effect is not weighed"),
    profiles::handled("accel.bandwidth_hz"),
    profiles::handled("accel.bandwidth_order"),
    profiles::left_out("accel.full_scale_g", "full scale", "saturated samples are passed over"),
    profiles::handled("accel.quantization_m_per_s"),
    profiles::left_out("temperature[].at_s", "temperature",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("temperature[].temperature_deg_c", "temperature",
                       "slow: first differences, which show the white noise, do not see it"),
    profiles::left_out("latency_s", "latency", "samples are compared by their time of validity"),
    profiles::left_out("drop_probability", "dropped samples", "samples that are not valid are passed over"),
};

inline constexpr profiles::FieldUse kGnssErrorUses[] = {
    profiles::no_error("fix_type", "says which fixes are weighed"),
    profiles::handled("position_sigma_ned_m"),
    profiles::handled("position_gm_sigma_ned_m"),
    profiles::handled("position_gm_correlation_time_s"),
    profiles::handled("velocity_sigma_ned_m_per_s"),
    profiles::handled("velocity_gm_sigma_ned_m_per_s"),
    profiles::handled("velocity_gm_correlation_time_s"),
    profiles::left_out("lesser_solutions[].fix_type", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].lasts_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].mean_time_between_falls_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].position_sigma_ned_m", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].position_gm_sigma_ned_m", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].position_gm_correlation_time_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].velocity_sigma_ned_m_per_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].velocity_gm_sigma_ned_m_per_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("lesser_solutions[].velocity_gm_correlation_time_s", "lesser solutions",
                       "only fixes of the profile's best solution are weighed"),
    profiles::left_out("latency_s", "latency", "fixes are compared by their time of validity"),
    profiles::no_error("satellite_model", "reported with a fix; no error follows from it"),
    profiles::no_error("elevation_mask_deg", "reported with a fix; no error follows from it"),
    profiles::no_error("satellites", "reported with a fix; no error follows from it"),
    profiles::no_error("hdop", "reported with a fix; no error follows from it"),
    profiles::no_error("vdop", "reported with a fix; no error follows from it"),
};

inline constexpr profiles::FieldUse kInstallationUses[] = {
    profiles::handled("lever_arm_v_m"),
    profiles::left_out("mounting_rpy_deg", "mounting angles", "the arms alone are weighed"),
};

inline constexpr profiles::FieldUse kVibrationUses[] = {
    profiles::handled("domain"),
    profiles::handled("linear[].amplitude_m_per_s2"),
    profiles::handled("linear[].frequency_hz"),
    profiles::no_error("linear[].phase_deg", "the spread does not depend on it"),
    profiles::handled("angular[].amplitude_deg_per_s"),
    profiles::handled("angular[].frequency_hz"),
    profiles::no_error("angular[].phase_deg", "the spread does not depend on it"),
    profiles::handled("linear_random[].frequency_hz"),
    profiles::handled("linear_random[].density_m2_per_s3"),
    profiles::handled("angular_random[].frequency_hz"),
    profiles::handled("angular_random[].density_deg2_per_s"),
};

inline constexpr profiles::FieldUse kFaultUses[] = {
    profiles::left_out("gyro_bias_jump_deg_per_h", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("accel_bias_jump_mgal", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::handled("gyro_noise_burst_deg_per_sqrt_h"),
    profiles::handled("accel_noise_burst_m_per_s_per_sqrt_h"),
    profiles::left_out("gyro_fault_x", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("gyro_fault_y", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("gyro_fault_z", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("accel_fault_x", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("accel_fault_y", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("accel_fault_z", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("gyro_silent", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("accel_silent", "faults", "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("position_jump_ned_m", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("velocity_jump_ned_m_per_s", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("position_drift_ned_m_per_s", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("drift_in_velocity", "faults",
                       "a fault promises no figure; its samples and their flags show it"),
    profiles::left_out("outage", "faults", "a fault promises no figure; its samples and their flags show it"),
};

/// Of each kind of profile.
constexpr const auto& uses_of(Tag<ImuErrorProfile>) { return kImuErrorUses; }
constexpr const auto& uses_of(Tag<GnssErrorProfile>) { return kGnssErrorUses; }
constexpr const auto& uses_of(Tag<InstallationProfile>) { return kInstallationUses; }
constexpr const auto& uses_of(Tag<VibrationProfile>) { return kVibrationUses; }
constexpr const auto& uses_of(Tag<FaultProfile>) { return kFaultUses; }

/// Of a swapped profile.
inline std::vector<std::string> names_left_out(const AnyProfile& profile) {
  return std::visit(
      [](const auto& one) { return profiles::names_left_out(uses_of(Tag<std::decay_t<decltype(one)>>{}), one); },
      profile);
}

}  // namespace inslab::cli::evidence
