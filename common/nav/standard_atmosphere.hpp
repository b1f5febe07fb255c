#pragma once

/// The standard atmosphere of ISO 2533:1975, which below 32 km is that of ICAO Doc 7488/3, and air that differs from it
/// by a pressure at sea level and by the same temperature everywhere.
namespace inslab::nav::standard_atmosphere {

inline constexpr double kSeaLevelPressurePa = 101325.0;
inline constexpr double kSeaLevelTemperatureK = 288.15;
inline constexpr double kZeroCelsiusK = 273.15;
inline constexpr double kGasConstantJPerKgK = 287.05287;  ///< of dry air: ISO 2533, table 1
inline constexpr double kGMPerS2 = 9.80665;
inline constexpr double kEarthRadiusM = 6356766.0;  ///< by which heights become geopotential: ISO 2533, 2.3

/// Height above mean sea level to geopotential height and back, m: ISO 2533, (8) and (9).
inline double geopotential_height_m(double height_m) { return kEarthRadiusM * height_m / (kEarthRadiusM + height_m); }
inline double height_m(double geopotential_height_m) {
  return kEarthRadiusM * geopotential_height_m / (kEarthRadiusM - geopotential_height_m);
}

/// Air at one place.
struct Air {
  double pressure_pa = kSeaLevelPressurePa;
  double temperature_k = kSeaLevelTemperatureK;

  double density_kg_per_m3() const { return pressure_pa / (kGasConstantJPerKgK * temperature_k); }
};

/// The air at a geopotential height, of a day that has this pressure at sea level and deviates by `deviation_k` from
/// the standard's temperature: the hydrostatic equation through the standard's layers. Above 80 km, where ISO 2533
/// ends, the temperature stays; below sea level the lowest layer goes on.
Air air_at(double geopotential_height_m, double sea_level_pressure_pa = kSeaLevelPressurePa, double deviation_k = 0.0);

/// The geopotential height at which the standard atmosphere has this pressure, m; NaN unless it is above 0.
double pressure_altitude_m(double pressure_pa);

}  // namespace inslab::nav::standard_atmosphere
