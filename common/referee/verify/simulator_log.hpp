#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

/// Logs of a commercial simulator: what it told its receiver at an instant.
namespace inslab::verify {

struct SimulatedRange {
  SatelliteId satellite;
  std::string rinex;  ///< of the signal
  time::GpsTime gps;
  double range_m = 0.0;        ///< geometric
  double pseudorange_m = 0.0;  ///< without what the atmosphere adds
  double rate_m_per_s = 0.0;   ///< of the pseudorange
};

/// A file of Skydel's logger, of one signal and one satellite, such as "E1 12.csv". Throws files::ReadError.
std::vector<SimulatedRange> read_skydel(const std::string& path, const SatelliteId& satellite,
                                        const std::string& rinex);

}  // namespace inslab::verify
