#include "inslab/models/navigation/matching_odometer.hpp"

#include <cmath>

#include "inslab/models/navigation/mounting.hpp"

namespace inslab::navigation {

void match(const OdometerErrorProfile& odometer, const InstallationProfile& place, const InstallationProfile& imu_place,
           NavigationParameters& p) {
  const bool is_first = p.odometer.number == odometer.target.number;
  if (!is_first && p.other_odometer.number != odometer.target.number) return;
  OdometerBelief& belief = is_first ? p.odometer : p.other_odometer;
  const nav::Matrix3 C_bv = axes_in_vehicle(imu_place).transpose();
  belief.lever_arm_b_m = C_bv * (place.lever_arm_v_m - imu_place.lever_arm_v_m);
  belief.mounting_rpy_deg = rpy_deg_of(C_bv * axes_in_vehicle(place));
  belief.scale_factor_sigma_ppm = std::hypot(odometer.scale_factor_ppm, odometer.scale_factor_turn_on_sigma_ppm);
  belief.scale_factor_drift_sigma_ppm = std::hypot(odometer.scale_factor_gm_sigma_ppm, odometer.tyre_warming_ppm);
  belief.scale_factor_drift_correlation_time_s = odometer.scale_factor_gm_sigma_ppm > 0.0
                                                     ? odometer.scale_factor_gm_correlation_time_s
                                                     : odometer.tyre_warming_time_s;
  belief.sigma_m_per_s = 0.002;  // an ideal one is believed to no less
  belief.noise_m_per_sqrt_m = odometer.noise_m_per_sqrt_m;
  belief.count_m =
      odometer.counts_per_revolution > 0.0 ? odometer.wheel_circumference_m / odometer.counts_per_revolution : 0.0;
  belief.dead_below_m_per_s = odometer.dead_below_m_per_s;
  belief.longitudinal_slip_threshold_m_per_s2 = odometer.longitudinal_slip_threshold_m_per_s2;
  belief.longitudinal_slip_s2_per_m = odometer.longitudinal_slip_s2_per_m;
  belief.lateral_slip_threshold_m_per_s2 = odometer.lateral_slip_threshold_m_per_s2;
  belief.lateral_slip_s2_per_m = odometer.lateral_slip_s2_per_m;
  (is_first ? p.states.wheel_scale : p.states.other_wheel_scale) =
      belief.scale_factor_sigma_ppm > 0.0 || belief.scale_factor_drift_sigma_ppm > 0.0;
  if (is_first) p.states.wheel_axis = true;
}

}  // namespace inslab::navigation
