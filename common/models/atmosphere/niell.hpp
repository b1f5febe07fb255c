#pragma once

#include "inslab/models/atmosphere/saastamoinen.hpp"

namespace inslab::atmosphere {

/// How many times the zenith's delay a line of sight has, of the dry gases and of water.
struct Mapping {
  double dry = 1.0;
  double wet = 1.0;
};

/// Source: A. Niell, Global mapping functions for the atmosphere delay at radio wavelengths, J. Geophys. Res. 101,
/// 1996: equations 4 to 6, tables 3 and 4, with the term of height. Elevations above 3 deg; `day_of_year` from 1, with
/// its part of the day, of which the season follows.
Mapping niell_mapping(const nav::Geodetic& antenna, double elevation_rad, double day_of_year);

}  // namespace inslab::atmosphere
