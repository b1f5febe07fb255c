#pragma once

#include <algorithm>
#include <cmath>

#include "inslab/data/profiles/magnetometer_error_profile.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::magnetometer {

/// Beyond this the strongest body that a profile may name adds less than 0.1 nT.
inline constexpr double kReachOfBodiesM = 10000.0;

/// The field of a ball of uniform magnetization, nT, at `from_body_m` from its centre, in the axes of `moment_a_m2`:
/// outside that of a dipole, mu_0/(4 pi) (3 (m . u) u - m)/r^3, inside the same everywhere, mu_0/(4 pi) 2 m/R^3.
/// J. D. Jackson, Classical Electrodynamics, third edition (1999), (5.56) and (5.105).
inline Vector3 field_of_ball_nt(const Vector3& moment_a_m2, double radius_m, const Vector3& from_body_m) {
  constexpr double kNtM3PerAM2 = 100.0;  // mu_0/(4 pi) = 1e-7 T m/A
  const double r_m = from_body_m.norm();
  if (r_m < radius_m) return (2.0 * kNtM3PerAM2 / (radius_m * radius_m * radius_m)) * moment_a_m2;
  const Vector3 u = from_body_m / r_m;
  return (kNtM3PerAM2 / (r_m * r_m * r_m)) * (3.0 * moment_a_m2.dot(u) * u - moment_a_m2);
}

/// The field of a body at a place, nT, in NED at the body, which within its reach is that at the place to 0.1 deg.
inline Vector3 field_n_nt(const MagneticBody& body, const nav::Geodetic& place) {
  const nav::Geodetic centre{body.latitude_deg * units::kDeg, body.longitude_deg * units::kDeg, body.height_m};
  const Vector3 from_body_m = nav::ned_from(centre, place);
  if (!(from_body_m.norm() < kReachOfBodiesM)) return Vector3::Zero();
  return field_of_ball_nt(body.moment_ned_a_m2, body.radius_m, from_body_m);
}

}  // namespace inslab::magnetometer
