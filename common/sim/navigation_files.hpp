#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/broadcast_ionosphere.hpp"
#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::sim {

/// What navigation files say, as far as it can be believed.
struct NavigationFiles {
  std::vector<KeplerianEphemeris> keplerian;
  std::vector<GlonassEphemeris> glonass;
  std::vector<BroadcastIonosphere> ionosphere;  ///< the first of each system
  std::vector<std::string> refused;             ///< records left out: file, line, satellite, why
};

/// Reads RINEX navigation files and leaves out records that agree with neither of their neighbours
/// (models/satellites/stray_records.hpp): receivers and networks do store such. Throws files::ReadError.
NavigationFiles load_navigation_files(const std::vector<std::string>& paths);

}  // namespace inslab::sim
