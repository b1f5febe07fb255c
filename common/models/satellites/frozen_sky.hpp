#pragma once

#include <vector>

#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/light_time.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"

namespace inslab::satellites {

/// A satellite above a receiver.
struct SkySight {
  SatelliteId satellite;
  std::int32_t channel = 0;  ///< of GLONASS
  Sight sight;
  AzimuthElevation direction;  ///< in the antenna's place's north, east, down
};

/// All satellites of a run, each on one orbit and with one clock from beginning to end; what they broadcast is that
/// orbit told anew in its system's time, rounded to the bits of the messages. Nothing depends on the order of the
/// ephemerides, or of the questions.
class FrozenSky {
 public:
  /// One healthy record a satellite: that with the reference nearest to `start`, of Galileo of I/NAV. Orbits go on from
  /// there for ever. A record further away than a week keeps its clock as it was, which years would take out of the
  /// messages; a state of GLONASS so far away is moved there in time, whole half hours: its equations know no date.
  FrozenSky(const BroadcastEphemerides& records, const time::GpsTime& start);

  /// Satellites at least that high, in the order of SatelliteId.
  std::vector<SkySight> seen_from(const AntennaState& antenna, double least_elevation_rad);

  /// The messages that are broadcast at an instant. Throws std::range_error, naming the satellite, when one does not
  /// fit its bits.
  BroadcastEphemerides messages_at(const time::GpsTime& gps);

  /// The orbits and clocks themselves.
  const std::vector<KeplerianEphemeris>& keplerian() const { return keplerian_; }

 private:
  std::vector<KeplerianEphemeris> keplerian_;
  std::vector<GlonassOrbit> glonass_;
};

}  // namespace inslab::satellites
