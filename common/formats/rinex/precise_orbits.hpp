#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::rinex {

/// What an SP3 file says of a satellite at an instant: its centre of mass, and its clock without relativity.
struct PreciseState {
  SatelliteId satellite;
  std::optional<Vector3> r_e_m;
  std::optional<double> clock_s;
};

struct PreciseEpoch {
  time::GpsTime gps;
  std::vector<PreciseState> states;
};

/// Reads orbits and clocks from an SP3 file of version c or d whose time is GPS time (S. Hilla, The Extended Standard
/// Product 3 Orbit Format). Position 0 and clock 999999.999999 are missing; satellites of other systems are left out.
/// Throws files::ReadError, naming the file, the line and what was expected.
std::vector<PreciseEpoch> read_precise_orbits(const std::string& path);

}  // namespace inslab::rinex
