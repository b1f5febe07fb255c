#pragma once

#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::trajectory {

/// Whether a line is a sentence of NMEA 0183, as receivers write them: "$GPGGA,...*hh".
bool is_nmea_sentence(std::string_view line);

/// The positions of a receiver's log of NMEA 0183 sentences. Source: NMEA 0183, GGA and RMC.
///
/// A row is a GGA sentence with a fix: the time of day (UTC; one that falls by more than half a day begins the next),
/// latitude, longitude, and the height above the ellipsoid, which is that above the geoid plus the geoid's. The date
/// comes from RMC; without one it is not known. Other sentences are passed over. A checksum that does not fit, a GGA
/// with a field that is no number, and one without the geoid's height are problems. Throws ReadError when the file
/// cannot be read at all.
TrajectoryReading read_trajectory_nmea(const std::string& path, const TrajectoryReadOptions& options);

}  // namespace inslab::trajectory
