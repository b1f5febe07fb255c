#pragma once

#include <cmath>

#include "inslab/nav/standard_atmosphere.hpp"

/// What moving air shows a probe, of a perfect gas with the ratio of specific heats of air, 1.4, and what an air data
/// computer makes of it. Source: NACA Report 1135, Equations, tables, and charts for compressible flow (1953), (31),
/// (43), (44), (100).
namespace inslab::nav::compressible_flow {

inline constexpr double kHeatRatio = 1.4;

/// m/s, at a static temperature in K.
inline double speed_of_sound_m_per_s(double temperature_k) {
  return std::sqrt(kHeatRatio * standard_atmosphere::kGasConstantJPerKgK * temperature_k);
}

/// Of total temperature to static temperature.
inline double temperature_ratio(double mach) { return 1.0 + 0.2 * mach * mach; }

/// Total pressure at the mouth of a pitot tube less the static pressure, over the static pressure: isentropic below the
/// speed of sound, behind the normal shock in front of the tube above it (Rayleigh).
///
///   q_c/p = (1 + 0.2 M^2)^3.5 - 1,    q_c/p = (1.2 M^2)^3.5 (6/(7 M^2 - 1))^2.5 - 1
inline double impact_ratio(double mach) {
  const double m2 = mach * mach;
  if (m2 <= 1.0) return std::expm1(3.5 * std::log1p(0.2 * m2));
  return std::pow(1.2 * m2, 3.5) * std::pow(6.0 / (7.0 * m2 - 1.0), 2.5) - 1.0;
}

/// The Mach number that has this ratio: in closed form below the speed of sound, by Newton's method in the logarithms
/// above it. 0 where the ratio is not above 0; NaN stays NaN.
inline double mach_of(double impact_ratio_of_it) {
  if (impact_ratio_of_it <= 0.0) return 0.0;
  constexpr double kAtTheSpeedOfSound = 0.8929291586;  // 1.2^3.5 - 1
  if (!(impact_ratio_of_it > kAtTheSpeedOfSound)) {
    return std::sqrt(5.0 * std::expm1(std::log1p(impact_ratio_of_it) / 3.5));
  }
  const double wanted = std::log1p(impact_ratio_of_it);
  double mach = std::sqrt((1.0 + impact_ratio_of_it) / 1.2);
  constexpr int kSteps = 8;  // from a start within a third it is at the rounding after five
  for (int step = 0; step < kSteps; ++step) {
    const double m2 = mach * mach;
    const double excess = 3.5 * std::log(1.2 * m2) + 2.5 * std::log(6.0 / (7.0 * m2 - 1.0)) - wanted;
    mach *= std::exp(-excess / (7.0 - 35.0 * m2 / (7.0 * m2 - 1.0)));
  }
  return mach;
}

/// Calibrated airspeed: that which has this impact pressure in the standard atmosphere at sea level.
inline double calibrated_airspeed_m_per_s(double impact_pressure_pa) {
  return speed_of_sound_m_per_s(standard_atmosphere::kSeaLevelTemperatureK) *
         mach_of(impact_pressure_pa / standard_atmosphere::kSeaLevelPressurePa);
}

/// True airspeed of a Mach number, at the total temperature that a probe in the flow has, K.
inline double true_airspeed_m_per_s(double mach, double total_temperature_k) {
  return mach * speed_of_sound_m_per_s(total_temperature_k / temperature_ratio(mach));
}

}  // namespace inslab::nav::compressible_flow
