#pragma once

#include "inslab/nav/geodesy.hpp"

namespace inslab::atmosphere {

/// Delays of the troposphere at the zenith, m, of the dry gases and of the water in it.
struct ZenithDelay {
  double dry_m = 0.0;
  double wet_m = 0.0;
};

/// Of a standard atmosphere: 1013.25 hPa, 15 C and that relative humidity at height 0, heights below it as 0. Source:
/// J. Saastamoinen, Atmospheric correction for the troposphere and stratosphere in radio ranging of satellites, 1972;
/// the dry part with the gravity of J. Davis and others, Geodesy by radio interferometry, 1985, equation A11. Pressure
/// and temperature: (1 - 2.2557e-5 h)^5.2568 and -6.5 K/km. Above 10 km and below -100 m there is none.
ZenithDelay saastamoinen_zenith(const nav::Geodetic& antenna, double relative_humidity = 0.7);

/// Both along a line of sight, m, by the cosecant of the elevation: what single-point positioning usually takes off. 0
/// at and below the horizon.
double saastamoinen_cosecant_m(const nav::Geodetic& antenna, double elevation_rad, double relative_humidity = 0.7);

}  // namespace inslab::atmosphere
