#pragma once

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/data/profiles/profile_uses.hpp"

/// What the prediction makes of each field of the profiles; ExpectedErrors::left_out() shows what it leaves out.
namespace inslab::predict {

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
    profiles::handled("gyro.scale_factor_temperature_ppm_per_deg_c"),
    profiles::handled("gyro.scale_factor_asymmetry_ppm"),
    profiles::handled("gyro.nonlinearity_ppm_of_full_scale"),
    profiles::handled("gyro.cross_axis_arcsec"),
    profiles::handled("gyro.g_sensitivity_deg_per_h_per_g"),
    profiles::left_out("gyro.bandwidth_hz", "bandwidth", "no linear form along the motion"),
    profiles::no_error("gyro.bandwidth_order", "shapes the bandwidth"),
    profiles::left_out("gyro.full_scale_deg_per_s", "full scale", "no linear form along the motion"),
    profiles::left_out("gyro.quantization_arcsec", "quantization", "no linear form along the motion"),
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
    profiles::handled("accel.scale_factor_temperature_ppm_per_deg_c"),
    profiles::handled("accel.scale_factor_asymmetry_ppm"),
    profiles::handled("accel.nonlinearity_ppm_of_full_scale"),
    profiles::handled("accel.nonlinearity_ppm_per_g"),
    profiles::handled("accel.cross_axis_arcsec"),
    profiles::left_out("accel.bandwidth_hz", "bandwidth", "no linear form along the motion"),
    profiles::no_error("accel.bandwidth_order", "shapes the bandwidth"),
    profiles::left_out("accel.full_scale_g", "full scale", "no linear form along the motion"),
    profiles::left_out("accel.quantization_m_per_s", "quantization", "no linear form along the motion"),
    profiles::handled("temperature[].at_s"),
    profiles::handled("temperature[].temperature_deg_c"),
    profiles::left_out("latency_s", "latency", "the prediction is of the time of validity"),
    profiles::left_out("drop_probability", "dropped samples", "no linear form along the motion"),
    profiles::left_out("accel_delay_s", "delay of a triad", "no linear form along the motion"),
    profiles::left_out("accel_place_m", "size effect", "needs the angular acceleration, which is not in the truth"),
    profiles::handled("gyro_cross_axis_gm_sigma_arcsec"),
    profiles::handled("gyro_cross_axis_gm_correlation_time_s"),
    profiles::handled("accel_cross_axis_gm_sigma_arcsec"),
    profiles::handled("accel_cross_axis_gm_correlation_time_s"),
    profiles::handled("gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min"),
    profiles::handled("accel_bias_temperature_rate_mgal_per_deg_c_per_min"),
    profiles::left_out("gyro_bias_hysteresis_deg_per_h", "hysteresis", "depends on where the temperature came from"),
    profiles::left_out("accel_bias_hysteresis_mgal", "hysteresis", "depends on where the temperature came from"),
    profiles::no_error("bias_hysteresis_width_deg_c", "shapes the hysteresis"),
    profiles::left_out("accel_rectification_mgal_per_g2", "rectified vibration",
                       "the vibration within an interval is not in the truth"),
    profiles::handled("gyro_g2_sensitivity_deg_per_h_per_g2"),
    profiles::handled("gyro_anisoelasticity_deg_per_h_per_g2"),
    profiles::handled("gyro_anisoinertia_deg_per_h_per_deg2_per_s2"),
    profiles::left_out("recorded_error.*", "recorded errors",
                       "a signal, not its statistics; inslab simulate and Monte Carlo have it"),
    profiles::left_out("time_tag.*", "time tags", "the prediction is of the time of validity"),
};

inline constexpr profiles::FieldUse kGnssErrorUses[] = {
    profiles::handled("fix_type"),
    profiles::handled("position_sigma_ned_m"),
    profiles::handled("position_gm_sigma_ned_m"),
    profiles::handled("position_gm_correlation_time_s"),
    profiles::handled("velocity_sigma_ned_m_per_s"),
    profiles::handled("velocity_gm_sigma_ned_m_per_s"),
    profiles::handled("velocity_gm_correlation_time_s"),
    profiles::handled("lesser_solutions[].fix_type"),
    profiles::no_error("lesser_solutions[].lasts_s", "fixes come with the solution that they had"),
    profiles::no_error("lesser_solutions[].mean_time_between_falls_s", "fixes come with the solution that they had"),
    profiles::handled("lesser_solutions[].position_sigma_ned_m"),
    profiles::handled("lesser_solutions[].position_gm_sigma_ned_m"),
    profiles::handled("lesser_solutions[].position_gm_correlation_time_s"),
    profiles::handled("lesser_solutions[].velocity_sigma_ned_m_per_s"),
    profiles::handled("lesser_solutions[].velocity_gm_sigma_ned_m_per_s"),
    profiles::handled("lesser_solutions[].velocity_gm_correlation_time_s"),
    profiles::no_error("latency_s", "each fix is taken in at its own time of validity"),
    profiles::no_error("satellite_model", "reported with a fix; no error follows from it"),
    profiles::no_error("elevation_mask_deg", "reported with a fix; no error follows from it"),
    profiles::no_error("satellites", "reported with a fix; no error follows from it"),
    profiles::no_error("hdop", "reported with a fix; no error follows from it"),
    profiles::no_error("vdop", "reported with a fix; no error follows from it"),
    profiles::left_out("recorded_error.*", "recorded errors",
                       "a signal, not its statistics; inslab simulate and Monte Carlo have it"),
    profiles::left_out("time_tag.*", "time tags", "the prediction is of the time of validity"),
    profiles::no_error("pps.*", "pulses are no part of a fix"),
};

inline constexpr profiles::FieldUse kInstallationUses[] = {
    profiles::handled("lever_arm_v_m"),
    profiles::handled("mounting_rpy_deg"),
    profiles::no_error("second_lever_arm_v_m",
                       "of a two-antenna heading alone, which the filter that is predicted does not take"),
};

/// Of the sensor's domain; a moving mount is part of the true motion.
inline constexpr profiles::FieldUse kSensorVibrationUses[] = {
    profiles::no_error("domain", "says whether the mount moves"),
    profiles::left_out("linear[].amplitude_m_per_s2", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::left_out("linear[].frequency_hz", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::no_error("linear[].phase_deg", "the same error, shifted"),
    profiles::left_out("angular[].amplitude_deg_per_s", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::left_out("angular[].frequency_hz", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::no_error("angular[].phase_deg", "the same error, shifted"),
    profiles::left_out("linear_random[].frequency_hz", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::left_out("linear_random[].density_m2_per_s3", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::left_out("angular_random[].frequency_hz", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
    profiles::left_out("angular_random[].density_deg2_per_s", "vibration of the output",
                       "the output is shaken, not the IMU: no error of the model"),
};

inline constexpr profiles::FieldUse kMagnetometerErrorUses[] = {
    profiles::left_out("", "magnetometers", "the filter that is predicted takes none")};

inline constexpr profiles::FieldUse kBarometerErrorUses[] = {
    profiles::left_out("", "barometers", "the filter that is predicted takes none")};

inline constexpr profiles::FieldUse kOdometerErrorUses[] = {
    profiles::left_out("", "odometers", "the filter that is predicted takes none")};

inline constexpr profiles::FieldUse kHeadingErrorUses[] = {
    profiles::left_out("", "two-antenna headings", "the filter that is predicted takes none")};

inline constexpr profiles::FieldUse kAirDataErrorUses[] = {
    profiles::left_out("", "air data probes", "the filter that is predicted takes none")};

inline constexpr profiles::FieldUse kFaultUses[] = {
    profiles::left_out("", "faults", "a fault is no error that a filter is told of")};

/// Of each kind of profile.
constexpr const auto& uses_of(Tag<ImuErrorProfile>) { return kImuErrorUses; }
constexpr const auto& uses_of(Tag<GnssErrorProfile>) { return kGnssErrorUses; }
constexpr const auto& uses_of(Tag<InstallationProfile>) { return kInstallationUses; }
constexpr const auto& uses_of(Tag<VibrationProfile>) { return kSensorVibrationUses; }
constexpr const auto& uses_of(Tag<FaultProfile>) { return kFaultUses; }
constexpr const auto& uses_of(Tag<MagnetometerErrorProfile>) { return kMagnetometerErrorUses; }
constexpr const auto& uses_of(Tag<BarometerErrorProfile>) { return kBarometerErrorUses; }
constexpr const auto& uses_of(Tag<OdometerErrorProfile>) { return kOdometerErrorUses; }
constexpr const auto& uses_of(Tag<HeadingErrorProfile>) { return kHeadingErrorUses; }
constexpr const auto& uses_of(Tag<AirDataErrorProfile>) { return kAirDataErrorUses; }

}  // namespace inslab::predict
