#pragma once

#include <cstdint>
#include <vector>

#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/geodesy.hpp"

/// Satellites on the nominal circular orbits of their constellation: no almanac, no health, no maneuvers. Enough for
/// how many are in view and for the geometry; real satellites keep their slots to a few degrees.
namespace inslab::gnss {

/// Positions in e, m, at a GPS time.
///
/// Gps: the 24 slots of the GPS SPS Performance Standard (October 2001), table 3-1: epoch 1993-07-01 00:00 UTC, with
/// the ground tracks that station keeping holds: two revolutions a sidereal day over a fixed node.
/// GpsGalileo: these and the 24 slots of the Galileo reference constellation (Walker 24/3/1, epoch 2016-11-21 00:00
/// UTC) with the rates published by the European GNSS Service Centre ("Orbital and technical parameters").
/// Stated: none.
std::vector<Vector3> satellites_e_m(SatelliteModel model, const time::GpsTime& time);

/// What a receiver can use of a sky.
struct Geometry {
  std::uint32_t satellites = 0;
  double hdop = 0.0;  ///< DOPs are 0 with fewer than four satellites and at most kMaxDop
  double vdop = 0.0;
};

inline constexpr std::uint32_t kFewestSatellites = 4;
inline constexpr double kMaxDop = 99.0;

/// The satellites at least `mask_rad` above the horizon of `antenna`, and the dilution of precision of a position and
/// one clock from them: the square roots of the diagonal of (G^T G)^-1, rows of G being (line of sight in NED, 1). The
/// offset between the constellations' times counts as known.
Geometry geometry_of(const nav::Geodetic& antenna, const std::vector<Vector3>& satellites_e_m, double mask_rad);

}  // namespace inslab::gnss
