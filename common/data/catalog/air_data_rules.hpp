#pragma once

#include <optional>
#include <string>

#include "inslab/data/catalog/correlation_rule.hpp"
#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/fields/violation.hpp"

/// Rules of an air data probe's profile that span several fields.
namespace inslab::catalog::detail {

inline std::optional<Violation> air_violation(const DaysAir& air) {
  if (auto broken =
          correlation_violation("air.sea_level_pressure_gm_correlation_time_s", "sea_level_pressure_gm_sigma_pa",
                                air.sea_level_pressure_gm_sigma_pa, air.sea_level_pressure_gm_correlation_time_s)) {
    return broken;
  }
  return correlation_violation("air.temperature_deviation_gm_correlation_time_s",
                               "temperature_deviation_gm_sigma_deg_c", air.temperature_deviation_gm_sigma_deg_c,
                               air.temperature_deviation_gm_correlation_time_s);
}

inline std::optional<Violation> wind_violation(const WindField& wind) {
  for (std::size_t i = 1; i < wind.levels.size(); ++i) {
    if (wind.levels[i].height_m > wind.levels[i - 1].height_m) continue;
    return Violation{Rule::WindLevels, "wind.levels[" + std::to_string(i) + "].height_m",
                     "is " + number_text(wind.levels[i].height_m) + "; expected above the one before, " +
                         number_text(wind.levels[i - 1].height_m)};
  }
  return std::nullopt;
}

inline std::optional<Violation> pressure_sensor_violation(const std::string& path, const PressureSensorErrors& sensor) {
  if (auto broken = correlation_violation((path + ".gm_correlation_time_s").c_str(), "gm_sigma_pa", sensor.gm_sigma_pa,
                                          sensor.gm_correlation_time_s)) {
    return broken;
  }
  const bool has_range = sensor.min_pressure_pa != 0.0 || sensor.max_pressure_pa != 0.0;
  if (!has_range || sensor.max_pressure_pa > sensor.min_pressure_pa) return std::nullopt;
  return Violation{Rule::PressureRange, path + ".max_pressure_pa",
                   "is " + number_text(sensor.max_pressure_pa) + "; expected above min_pressure_pa, " +
                       number_text(sensor.min_pressure_pa) + " (both 0: no range)"};
}

inline std::optional<Violation> vane_violation(const std::string& path, const VaneErrors& vane) {
  return correlation_violation((path + ".gm_correlation_time_s").c_str(), "gm_sigma_deg", vane.gm_sigma_deg,
                               vane.gm_correlation_time_s);
}

/// All of them.
inline std::optional<Violation> air_data_violation(const AirDataErrorProfile& profile) {
  if (auto broken = air_violation(profile.air)) return broken;
  if (auto broken = wind_violation(profile.wind)) return broken;
  if (auto broken = pressure_sensor_violation("impact_pressure", profile.impact_pressure)) return broken;
  if (auto broken = pressure_sensor_violation("static_pressure", profile.static_pressure)) return broken;
  if (auto broken = vane_violation("angle_of_attack", profile.angle_of_attack)) return broken;
  return vane_violation("angle_of_sideslip", profile.angle_of_sideslip);
}

}  // namespace inslab::catalog::detail
