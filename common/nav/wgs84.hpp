#pragma once

#include <cmath>

/// The WGS-84 ellipsoid and its two radii of curvature.
///
/// Source of the constants: NIMA TR8350.2, third edition, tables 3.1, 3.3 and 3.4 (GM as amended in 2000). The rate of
/// the Earth is the table's 7292115e-11 rad/s.
namespace inslab::nav::wgs84 {

inline constexpr double a_m = 6378137.0;                  ///< equatorial radius
inline constexpr double f = 1.0 / 298.257223563;          ///< flattening
inline constexpr double b_m = a_m * (1.0 - f);            ///< polar radius
inline constexpr double e2 = f * (2.0 - f);               ///< first eccentricity squared
inline constexpr double omega_e_rad_per_s = 7.292115e-5;  ///< rate of the Earth
inline constexpr double gm_m3_per_s2 = 3.986004418e14;    ///< gravitational constant of the Earth, atmosphere included

/// Radius of curvature in the meridian, M in m, from sin(latitude): thesis (3-28).
inline double meridian_radius_from_sine_m(double sin_latitude) {
  const double w2 = 1.0 - e2 * sin_latitude * sin_latitude;
  return a_m * (1.0 - e2) / (w2 * std::sqrt(w2));
}

/// Radius of curvature in the prime vertical, N in m, from sin(latitude): thesis (3-29).
inline double transverse_radius_from_sine_m(double sin_latitude) {
  return a_m / std::sqrt(1.0 - e2 * sin_latitude * sin_latitude);
}

/// Radius of curvature in the meridian, M in m: thesis (3-28).
inline double meridian_radius_m(double latitude_rad) { return meridian_radius_from_sine_m(std::sin(latitude_rad)); }

/// Radius of curvature in the prime vertical, N in m: thesis (3-29).
inline double transverse_radius_m(double latitude_rad) { return transverse_radius_from_sine_m(std::sin(latitude_rad)); }

}  // namespace inslab::nav::wgs84
