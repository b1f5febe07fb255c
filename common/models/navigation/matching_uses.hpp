#pragma once

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/data/profiles/profile_uses.hpp"

/// What matching_parameters() makes of each field of the profiles of a unit; left_out_of_matching() shows what it
/// leaves out.
namespace inslab::navigation::matching {

inline constexpr profiles::FieldUse kImuErrorUses[] = {
    profiles::handled("gyro.bias_constant_deg_per_h"),
    profiles::handled("gyro.bias_turn_on_sigma_deg_per_h"),
    profiles::handled("gyro.bias_gm_sigma_deg_per_h"),
    profiles::handled("gyro.bias_gm_correlation_time_s"),
    profiles::handled("gyro.bias_random_walk_deg_per_h_per_sqrt_h"),
    profiles::handled("gyro.bias_instability_deg_per_h"),
    profiles::handled("gyro.bias_temperature_deg_per_h_per_deg_c"),
    profiles::handled("gyro.arw_deg_per_sqrt_h"),
    profiles::handled("gyro.scale_factor_ppm"),
    profiles::handled("gyro.scale_factor_turn_on_sigma_ppm"),
    profiles::handled("gyro.scale_factor_gm_sigma_ppm"),
    profiles::handled("gyro.scale_factor_gm_correlation_time_s"),
    profiles::left_out("gyro.scale_factor_temperature_ppm_per_deg_c", "scale factor by temperature",
                       "small beside the scale factor terms in every profile of config"),
    profiles::handled("gyro.scale_factor_asymmetry_ppm"),
    profiles::handled("gyro.nonlinearity_ppm_of_full_scale"),
    profiles::handled("gyro.cross_axis_arcsec"),
    profiles::handled("gyro.g_sensitivity_deg_per_h_per_g"),
    profiles::left_out("gyro.bandwidth_hz", "bandwidth", "the filter takes white noise for white"),
    profiles::no_error("gyro.bandwidth_order", "shapes the bandwidth"),
    profiles::no_error("gyro.full_scale_deg_per_s", "saturated samples come marked as such and the filter doubts them"),
    profiles::left_out("gyro.quantization_arcsec", "quantization",
                       "small beside the white noise in every profile of config"),
    profiles::handled("accel.bias_constant_mgal"),
    profiles::handled("accel.bias_turn_on_sigma_mgal"),
    profiles::handled("accel.bias_gm_sigma_mgal"),
    profiles::handled("accel.bias_gm_correlation_time_s"),
    profiles::handled("accel.bias_random_walk_mgal_per_sqrt_h"),
    profiles::handled("accel.bias_instability_mgal"),
    profiles::handled("accel.bias_temperature_mgal_per_deg_c"),
    profiles::handled("accel.vrw_m_per_s_per_sqrt_h"),
    profiles::handled("accel.scale_factor_ppm"),
    profiles::handled("accel.scale_factor_turn_on_sigma_ppm"),
    profiles::handled("accel.scale_factor_gm_sigma_ppm"),
    profiles::handled("accel.scale_factor_gm_correlation_time_s"),
    profiles::left_out("accel.scale_factor_temperature_ppm_per_deg_c", "scale factor by temperature",
                       "small beside the scale factor terms in every profile of config"),
    profiles::handled("accel.scale_factor_asymmetry_ppm"),
    profiles::handled("accel.nonlinearity_ppm_of_full_scale"),
    profiles::left_out("accel.nonlinearity_ppm_per_g", "non-linearity by the force",
                       "the filter has no state that grows with the square of a force"),
    profiles::handled("accel.cross_axis_arcsec"),
    profiles::left_out("accel.bandwidth_hz", "bandwidth", "the filter takes white noise for white"),
    profiles::no_error("accel.bandwidth_order", "shapes the bandwidth"),
    profiles::no_error("accel.full_scale_g", "saturated samples come marked as such and the filter doubts them"),
    profiles::left_out("accel.quantization_m_per_s", "quantization",
                       "small beside the white noise in every profile of config"),
    profiles::handled("temperature[].at_s"),
    profiles::handled("temperature[].temperature_deg_c"),
    profiles::no_error("latency_s", "samples come with their own time"),
    profiles::no_error("drop_probability", "dropped samples come marked as such and the filter bridges them"),
    profiles::left_out("accel_delay_s", "delay of a triad", "the filter takes both triads to feel the same interval"),
    profiles::left_out("accel_place_m", "size effect", "the filter takes the accelerometers to sit at one point"),
    profiles::left_out("gyro_cross_axis_gm_sigma_arcsec", "drifting cross-axis angles",
                       "small beside the fixed ones in every profile of config"),
    profiles::left_out("gyro_cross_axis_gm_correlation_time_s", "drifting cross-axis angles",
                       "small beside the fixed ones in every profile of config"),
    profiles::left_out("accel_cross_axis_gm_sigma_arcsec", "drifting cross-axis angles",
                       "small beside the fixed ones in every profile of config"),
    profiles::left_out("accel_cross_axis_gm_correlation_time_s", "drifting cross-axis angles",
                       "small beside the fixed ones in every profile of config"),
    profiles::left_out("gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min", "bias by the change of temperature",
                       "the filter has no state for it"),
    profiles::left_out("accel_bias_temperature_rate_mgal_per_deg_c_per_min", "bias by the change of temperature",
                       "the filter has no state for it"),
    profiles::left_out("gyro_bias_hysteresis_deg_per_h", "bias by the change of temperature",
                       "the filter has no state for it"),
    profiles::left_out("accel_bias_hysteresis_mgal", "bias by the change of temperature",
                       "the filter has no state for it"),
    profiles::no_error("bias_hysteresis_width_deg_c", "shapes the hysteresis"),
    profiles::left_out("accel_rectification_mgal_per_g2", "rectified vibration",
                       "its strength is none of the filter, which is told of no vibration"),
    profiles::left_out("gyro_g2_sensitivity_deg_per_h_per_g2", "second-order drift",
                       "the filter has no state that grows with the square of a force or a rate"),
    profiles::left_out("gyro_anisoelasticity_deg_per_h_per_g2", "second-order drift",
                       "the filter has no state that grows with the square of a force or a rate"),
    profiles::left_out("gyro_anisoinertia_deg_per_h_per_deg2_per_s2", "second-order drift",
                       "the filter has no state that grows with the square of a force or a rate"),
    profiles::left_out("recorded_error.*", "recorded errors",
                       "a signal, not its statistics; give the filter those of its twin (inslab allan --profile)"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
};

inline constexpr profiles::FieldUse kGnssErrorUses[] = {
    profiles::no_error("fix_type", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("position_sigma_ned_m", "a fix says itself how unsure it is and when it was valid"),
    profiles::left_out("position_gm_sigma_ned_m", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::left_out("position_gm_correlation_time_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::no_error("velocity_sigma_ned_m_per_s", "a fix says itself how unsure it is and when it was valid"),
    profiles::left_out("velocity_gm_sigma_ned_m_per_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::left_out("velocity_gm_correlation_time_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::no_error("lesser_solutions[].fix_type", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("lesser_solutions[].lasts_s", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("lesser_solutions[].mean_time_between_falls_s",
                       "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("lesser_solutions[].position_sigma_ned_m",
                       "a fix says itself how unsure it is and when it was valid"),
    profiles::left_out("lesser_solutions[].position_gm_sigma_ned_m", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::left_out("lesser_solutions[].position_gm_correlation_time_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::no_error("lesser_solutions[].velocity_sigma_ned_m_per_s",
                       "a fix says itself how unsure it is and when it was valid"),
    profiles::left_out("lesser_solutions[].velocity_gm_sigma_ned_m_per_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::left_out("lesser_solutions[].velocity_gm_correlation_time_s", "slow errors of fixes",
                       "a fix says how unsure it is, not that the next errs alike"),
    profiles::no_error("latency_s", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("satellite_model", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("elevation_mask_deg", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("satellites", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("hdop", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("vdop", "a fix says itself how unsure it is and when it was valid"),
    profiles::no_error("recorded_error.*", "fixes come with what the real receiver claimed"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
    profiles::no_error("pps.*", "pulses are no part of a fix"),
};

inline constexpr profiles::FieldUse kInstallationUses[] = {
    profiles::handled("lever_arm_v_m"),
    profiles::handled("mounting_rpy_deg"),
    profiles::handled("second_lever_arm_v_m"),
};

inline constexpr profiles::FieldUse kVibrationUses[] = {
    profiles::no_error("domain", "says whether the mount moves"),
    profiles::left_out("linear[].amplitude_m_per_s2", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("linear[].frequency_hz", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("linear[].phase_deg", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("angular[].amplitude_deg_per_s", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("angular[].frequency_hz", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("angular[].phase_deg", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("linear_random[].frequency_hz", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("linear_random[].density_m2_per_s3", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("angular_random[].frequency_hz", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
    profiles::left_out("angular_random[].density_deg2_per_s", "vibration",
                       "its spectrum is none of the filter, which is told of white noise alone"),
};

inline constexpr profiles::FieldUse kMagnetometerErrorUses[] = {
    profiles::handled("hard_iron_nt"),
    profiles::handled("soft_iron"),
    profiles::no_error("currents[].at_s", "shapes the currents"),
    profiles::handled("currents[].B_b_nt"),
    profiles::left_out("bodies[].latitude_deg", "iron beside the way", "the innovation test is there for it"),
    profiles::left_out("bodies[].longitude_deg", "iron beside the way", "the innovation test is there for it"),
    profiles::left_out("bodies[].height_m", "iron beside the way", "the innovation test is there for it"),
    profiles::left_out("bodies[].radius_m", "iron beside the way", "the innovation test is there for it"),
    profiles::left_out("bodies[].moment_ned_a_m2", "iron beside the way", "the innovation test is there for it"),
    profiles::handled("white_sigma_nt"),
    profiles::handled("gm_sigma_nt"),
    profiles::handled("gm_correlation_time_s"),
    profiles::no_error("full_scale_nt", "saturated samples come marked as such and are not used"),
    profiles::handled("quantization_nt"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
};

inline constexpr profiles::FieldUse kBarometerErrorUses[] = {
    profiles::handled("geoid_height_m"),
    profiles::handled("sea_level_pressure_pa"),
    profiles::handled("sea_level_pressure_rate_pa_per_h"),
    profiles::handled("sea_level_pressure_gm_sigma_pa"),
    profiles::handled("sea_level_pressure_gm_correlation_time_s"),
    profiles::handled("temperature_deviation_deg_c"),
    profiles::handled("temperature_deviation_gm_sigma_deg_c"),
    profiles::left_out("temperature_deviation_gm_correlation_time_s", "drift of the air's temperature",
                       "its deviation is taken for a constant of its size"),
    profiles::handled("static_pressure_coefficient"),
    profiles::handled("time_constant_s"),
    profiles::handled("offset_pa"),
    profiles::handled("white_sigma_pa"),
    profiles::handled("gm_sigma_pa"),
    profiles::handled("gm_correlation_time_s"),
    profiles::no_error("min_pressure_pa", "saturated samples come marked as such and are not used"),
    profiles::no_error("max_pressure_pa", "saturated samples come marked as such and are not used"),
    profiles::handled("quantization_pa"),
    profiles::no_error("temperature_offset_deg_c", "the filter does not look at the temperature"),
    profiles::no_error("temperature_white_sigma_deg_c", "the filter does not look at the temperature"),
    profiles::no_error("temperature_quantization_deg_c", "the filter does not look at the temperature"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
};

inline constexpr profiles::FieldUse kOdometerErrorUses[] = {
    profiles::handled("scale_factor_ppm"),
    profiles::handled("scale_factor_turn_on_sigma_ppm"),
    profiles::handled("scale_factor_gm_sigma_ppm"),
    profiles::handled("scale_factor_gm_correlation_time_s"),
    profiles::handled("tyre_warming_ppm"),
    profiles::handled("tyre_warming_time_s"),
    profiles::handled("noise_m_per_sqrt_m"),
    profiles::no_error("longitudinal_slip_threshold_m_per_s2", "shapes the slip"),
    profiles::left_out("longitudinal_slip_s2_per_m", "slip of wheels", "the innovation test is there for it"),
    profiles::no_error("lateral_slip_threshold_m_per_s2", "shapes the slip"),
    profiles::left_out("lateral_slip_s2_per_m", "slip of wheels", "the innovation test is there for it"),
    profiles::handled("counts_per_revolution"),
    profiles::handled("wheel_circumference_m"),
    profiles::handled("dead_below_m_per_s"),
    profiles::no_error("direction_known", "a sample says it itself"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
};

inline constexpr profiles::FieldUse kHeadingErrorUses[] = {
    profiles::handled("fix_type"),
    profiles::handled("relative_sigma_ned_m"),
    profiles::handled("relative_gm_sigma_ned_m"),
    profiles::handled("relative_gm_correlation_time_s"),
    profiles::no_error("lesser_solutions[].fix_type", "the best solution alone is used"),
    profiles::no_error("lesser_solutions[].lasts_s", "the best solution alone is used"),
    profiles::no_error("lesser_solutions[].mean_time_between_falls_s", "the best solution alone is used"),
    profiles::no_error("lesser_solutions[].relative_sigma_ned_m", "the best solution alone is used"),
    profiles::no_error("lesser_solutions[].relative_gm_sigma_ned_m", "the best solution alone is used"),
    profiles::no_error("lesser_solutions[].relative_gm_correlation_time_s", "the best solution alone is used"),
    profiles::left_out("mean_time_between_wrong_fixes_s", "wrong fixes", "the innovation test is there for them"),
    profiles::left_out("wrong_fix_lasts_s", "wrong fixes", "the innovation test is there for them"),
    profiles::left_out("wrong_fix_offset_m", "wrong fixes", "the innovation test is there for them"),
    profiles::left_out("time_tag.*", "time tags", "the filter takes every tag for the time of validity"),
};

inline constexpr profiles::FieldUse kAirDataErrorUses[] = {
    profiles::left_out("", "air data probes", "the filter takes none")};

inline constexpr profiles::FieldUse kFaultUses[] = {
    profiles::left_out("", "faults", "a fault is no error that a filter is told of")};

/// Of each kind of profile.
constexpr const auto& uses_of(Tag<ImuErrorProfile>) { return kImuErrorUses; }
constexpr const auto& uses_of(Tag<GnssErrorProfile>) { return kGnssErrorUses; }
constexpr const auto& uses_of(Tag<InstallationProfile>) { return kInstallationUses; }
constexpr const auto& uses_of(Tag<VibrationProfile>) { return kVibrationUses; }
constexpr const auto& uses_of(Tag<FaultProfile>) { return kFaultUses; }
constexpr const auto& uses_of(Tag<MagnetometerErrorProfile>) { return kMagnetometerErrorUses; }
constexpr const auto& uses_of(Tag<BarometerErrorProfile>) { return kBarometerErrorUses; }
constexpr const auto& uses_of(Tag<OdometerErrorProfile>) { return kOdometerErrorUses; }
constexpr const auto& uses_of(Tag<HeadingErrorProfile>) { return kHeadingErrorUses; }
constexpr const auto& uses_of(Tag<AirDataErrorProfile>) { return kAirDataErrorUses; }

}  // namespace inslab::navigation::matching
