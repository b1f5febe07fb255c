#include "inslab/models/navigation/matching_barometer.hpp"

#include <cmath>

#include "inslab/models/navigation/mounting.hpp"
#include "inslab/nav/standard_atmosphere.hpp"

namespace inslab::navigation {

namespace {

namespace air = nav::standard_atmosphere;

/// Of the standard's lowest air.
constexpr double kMetresPerPa =
    air::kGasConstantJPerKgK * air::kSeaLevelTemperatureK / (air::kGMPerS2 * air::kSeaLevelPressurePa);
/// How long the weather's rate is let go on before fixes have shown where it led.
constexpr double kRateFor_h = 1.0 / 6.0;
/// Of a weather that has a rate and no drift.
constexpr double kRateCorrelation_s = 3600.0;

}  // namespace

void match(const BarometerErrorProfile& barometer, const InstallationProfile& place,
           const InstallationProfile& imu_place, NavigationParameters& p) {
  BarometerBelief& belief = p.barometer;
  belief.lever_arm_b_m = axes_in_vehicle(imu_place).transpose() * (place.lever_arm_v_m - imu_place.lever_arm_v_m);
  belief.lag_s = barometer.time_constant_s;
  // A count is uniform over its width; an ideal one is believed to less than its bits.
  belief.white_sigma_pa =
      std::max(0.1, std::hypot(barometer.white_sigma_pa, barometer.quantization_pa / std::sqrt(12.0)));
  const double sea_level_m = kMetresPerPa * (barometer.sea_level_pressure_pa - air::kSeaLevelPressurePa);
  const double drift_pa =
      std::hypot(barometer.sea_level_pressure_gm_sigma_pa, kRateFor_h * barometer.sea_level_pressure_rate_pa_per_h);
  belief.bias_sigma_m = Vector3(std::hypot(barometer.geoid_height_m, sea_level_m, kMetresPerPa * barometer.offset_pa),
                                kMetresPerPa * drift_pa, kMetresPerPa * barometer.gm_sigma_pa);
  belief.bias_correlation_time_s =
      Vector3(0.0,
              barometer.sea_level_pressure_gm_sigma_pa > 0.0 ? barometer.sea_level_pressure_gm_correlation_time_s
                                                             : kRateCorrelation_s,
              barometer.gm_correlation_time_s);
  belief.height_scale_sigma =
      std::hypot(barometer.temperature_deviation_deg_c, barometer.temperature_deviation_gm_sigma_deg_c) /
      air::kSeaLevelTemperatureK;
  belief.static_pressure_sigma = std::abs(barometer.static_pressure_coefficient);
  p.states.pressure_bias = !belief.bias_sigma_m.isZero(0.0);
  p.states.pressure_slope = belief.height_scale_sigma > 0.0 || belief.static_pressure_sigma > 0.0;
}

}  // namespace inslab::navigation
