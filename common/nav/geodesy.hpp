#pragma once

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// A position on or above the WGS-84 ellipsoid.
struct Geodetic {
  double latitude_rad = 0.0;   ///< [-pi/2, pi/2]
  double longitude_rad = 0.0;  ///< functions that return one keep it in [-pi, pi]
  double height_m = 0.0;       ///< above the ellipsoid
};

/// What the simulation is valid for; n has no meaning at a pole, and gravity's height series ends at 100 km.
inline constexpr double kMaxLatitudeDeg = 89.9;
inline constexpr double kMinHeightM = -1000.0;
inline constexpr double kMaxHeightM = 100000.0;

/// True where |latitude| <= 89.9 deg, -1 km <= height <= 100 km and nothing is NaN.
bool in_domain(const Geodetic& position);

/// Throws std::domain_error, naming the quantity, its value and its limits, where in_domain() is false.
void check_domain(const Geodetic& position);

/// Coordinates in e, m, everywhere: to the rounding of the results, 5e-10 m near the ground.
Vector3 ecef_from_geodetic(const Geodetic& position);

/// Inverse of ecef_from_geodetic(), to rounding of the results (half a unit in the last place of a longitude of 3 rad
/// is 1.4e-9 m) from 100 km under the ellipsoid to 1e8 m above it; at a pole the longitude is 0. Method: Bowring's
/// first approximation, then Newton steps along and across the ellipsoid's normal. Throws std::domain_error when the
/// point is further down than that or not finite.
Geodetic geodetic_from_ecef(const Vector3& r_e_m);

/// Takes NED coordinates at a point of this latitude and longitude to e: v_e = C_en v_n.
Matrix3 C_en(double latitude_rad, double longitude_rad);

/// The same from the sines and cosines, for callers that have them.
Matrix3 C_en(double sin_latitude, double cos_latitude, double sin_longitude, double cos_longitude);

/// How latitude, longitude and height change along the straight line `ned_m` (NED at `origin`), exactly through ECEF
/// but without its cancellation: a change is good to 1e-15 of the length of the line. Lines up to 1000 km.
Geodetic geodetic_change(const Geodetic& origin, const Vector3& ned_m);

/// The point at the end of the line `ned_m` (NED at `origin`): origin + geodetic_change(), longitude in [-pi, pi].
Geodetic displaced(const Geodetic& origin, const Vector3& ned_m);

/// The straight line from `origin` to `point` in NED at `origin`, m: inverse of displaced(), without the cancellation
/// of two ECEF positions; what remains is the rounding of the angles themselves (some 1e-9 m).
Vector3 ned_from(const Geodetic& origin, const Geodetic& point);

/// Rate of e relative to i in n, rad/s: thesis (3-26).
Vector3 omega_ie_n(double latitude_rad);

/// Rate of n relative to e in n (transport rate), rad/s, for a velocity `v_n` in m/s: thesis (3-27).
Vector3 omega_en_n(const Geodetic& position, const Vector3& v_n);

/// `angle_rad` less whole turns, in [-pi, pi]; angles already there are returned unchanged.
double wrapped_to_pi(double angle_rad);

}  // namespace inslab::nav
