#pragma once

#include "inslab/data/samples/gnss_system.hpp"

namespace inslab::satellites {

/// The Earth as the users of a system's messages must take it: the messages are fitted with it.
struct OrbitConstants {
  double mu_m3_per_s2;
  double omega_e_rad_per_s;
};

/// IS-GPS-200, table 20-IV (QZSS alike); Galileo OS SIS ICD, table 58; BeiDou B1I ICD, table 5-11; GLONASS ICD 5.1,
/// table 3.2. The Earth rates differ: the other system's in an orbit is up to 23 m at the end of a week.
constexpr OrbitConstants orbit_constants(GnssSystem system) {
  switch (system) {
    case GnssSystem::Galileo:
      return {3.986004418e14, 7.2921151467e-5};
    case GnssSystem::BeiDou:
      return {3.986004418e14, 7.292115e-5};
    case GnssSystem::Glonass:
      return {3.9860044e14, 7.292115e-5};
    case GnssSystem::Gps:
    case GnssSystem::Qzss:
      break;
  }
  return {3.986005e14, 7.2921151467e-5};
}

/// The Earth's equatorial radius and flattening term of PZ-90.11 (GLONASS ICD 5.1, table 3.2).
inline constexpr double kPz90Radius_m = 6378136.0;
inline constexpr double kPz90J2 = 1.0826257e-3;

}  // namespace inslab::satellites
