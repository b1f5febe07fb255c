#pragma once

#include <array>
#include <vector>

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::satellites {

/// Orbits that a family of satellites shares, as seen at an epoch.
struct SlotOrbits {
  time::GpsTime epoch;
  double greenwich_deg;  ///< hour angle of Greenwich at the epoch
  double radius_m;
  double inclination_deg;
  double node_rate_rad_per_s;      ///< relative to the stars
  double argument_rate_rad_per_s;  ///< of latitude
  double eccentricity = 0.0;       ///< where messages are made of it: the largest, or that of all
  bool is_eccentricity_drawn = true;
  double perigee_deg = 0.0;  ///< where the eccentricity is not drawn
};

/// Where one of them is at the epoch: its node, relative to the stars, and its argument of latitude.
struct Slot {
  SatelliteId satellite;
  double node_deg;
  double argument_deg;
};

struct SlotFamily {
  SlotOrbits orbits;
  std::vector<Slot> slots;
};

/// All families. First GPS: the 24 slots of the GPS SPS Performance Standard (October 2001), table 3-1. Second Galileo:
/// the Walker 24/3/1 reference constellation of the European GNSS Service Centre ("Orbital and technical parameters").
const std::vector<SlotFamily>& nominal_slots();

/// Frequency channels of GLONASS by slot: opposite satellites of a plane share one.
inline constexpr std::array<std::int8_t, 24> kGlonassChannels{1,  -4, 5, 6,  1, -4, 5, 6, -2, -7, 0, -1,
                                                              -2, -7, 0, -1, 4, -3, 3, 2, 4,  -3, 3, 2};

}  // namespace inslab::satellites
