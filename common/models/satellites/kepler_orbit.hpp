#pragma once

#include "inslab/data/samples/keplerian_ephemeris.hpp"
#include "inslab/models/satellites/satellite_state.hpp"

namespace inslab::satellites {

/// The eccentric anomaly of a mean anomaly, rad: Newton's method until E - e sin E = M to 1e-14 rad (in a few steps for
/// any eccentricity below 0.9).
double eccentric_anomaly_rad(double mean_anomaly_rad, double eccentricity);

/// A satellite by its Keplerian ephemeris.
///
/// Source: IS-GPS-200, 20.3.3.4.3 and table 20-IV, velocity as their exact derivative; clock 20.3.3.3.3.1, drift with
/// the derivative of the relativistic term. BeiDou's geostationary satellites: B1I ICD 3.0, 5.2.4.12 (table 5-11), an
/// orbit that stands 5 deg askew and turns with the Earth. The acceleration is gravity's (turning_gravity): for the
/// fractions of a second between an instant and the satellite's time of transmission.
SatelliteState kepler_state(const KeplerianEphemeris& ephemeris, const time::GpsTime& gps);

/// Mean motion, rad/s, that of table 20-IV: with the ephemeris's own correction.
double mean_motion_rad_per_s(const KeplerianEphemeris& ephemeris);

/// Tilt of the orbits of BeiDou's geostationary satellites in their messages, rad.
double geostationary_tilt_rad();

}  // namespace inslab::satellites
