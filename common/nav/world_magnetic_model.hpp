#pragma once

#include <array>

#include "inslab/nav/geodesy.hpp"

namespace inslab::nav {

/// The magnetic field of the Earth's core and crust, World Magnetic Model 2025: degree and order 12, linear in time.
///
/// Source: NOAA NCEI and British Geological Survey, The US/UK World Magnetic Model for 2025-2030 (2024): equations (9)
/// to (17), coefficients of WMM.COF of 2024-11-13. Its own estimate of what it leaves out (crust, ionosphere, storms)
/// is 137 nT north, 89 nT east, 141 nT down, one sigma.
class WorldMagneticModel {
 public:
  static constexpr double kFirstYear = 2025.0;
  static constexpr double kLastYear = 2030.0;

  /// The field of one date, in decimal years. Dates outside 2025 to 2030 are extrapolated in the same line, and it is
  /// for the caller to allow that.
  explicit WorldMagneticModel(double decimal_year);

  /// The secular change itself: B_n_nt() then is in nT a year, the same at every date.
  static WorldMagneticModel secular_change();

  /// The field north, east, down at a point, nT. From the ground to 850 km the model promises its accuracy; the series
  /// converges everywhere outside the core, poles included (there north is that of the longitude).
  Vector3 B_n_nt(const Geodetic& position) const;

 private:
  static constexpr int kDegree = 12;
  static constexpr int kTerms = (kDegree + 1) * (kDegree + 2) / 2;
  /// Coefficients of cos(m longitude) and sin(m longitude), nT, for Legendre functions in Gauss's normalization.
  struct Term {
    double g = 0.0;
    double h = 0.0;
  };

  WorldMagneticModel(double share_of_field, double years_of_change);

  std::array<Term, kTerms> terms_;  ///< n rising from 0, m from 0 to n
};

/// Declination (east of north) and inclination (below the horizon) of a field in n, rad.
double declination_rad(const Vector3& B_n);
double inclination_rad(const Vector3& B_n);

}  // namespace inslab::nav
