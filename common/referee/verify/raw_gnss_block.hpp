#pragma once

#include <functional>
#include <string>
#include <vector>

#include "inslab/data/samples/keplerian_ephemeris.hpp"
#include "inslab/models/satellites/light_time.hpp"
#include "inslab/models/satellites/satellite_state.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// What the block puts to the test: a satellite's state, and the way of its signal.
struct RawGnssSubjects {
  std::function<satellites::SatelliteState(const KeplerianEphemeris&, const time::GpsTime&)> state;
  std::function<satellites::Sight(const satellites::Departure&, const satellites::AntennaState&)> sight;
};
RawGnssSubjects product_satellites();

/// Broadcast orbits and clocks of two days against precise ones: brdc1820.10n with igs15904.sp3 (GPS, 2010-07-01) and
/// the mixed file of 2023-01-08 with GFZ's multi-GNSS orbits, in `folder`.
Table raw_gnss_orbits(const std::string& folder, const RawGnssSubjects& subjects = product_satellites());

/// Pseudoranges and their rates against logs of a commercial simulator without errors, in `folder`, by the messages
/// that it broadcast.
Table raw_gnss_ranges(const std::string& folder, const RawGnssSubjects& subjects = product_satellites());

/// `inslab verify raw_gnss --files FOLDER`: both tables. Of what is not in the folder the rows are left out, and the
/// table names them; without a folder all are. Throws files::ReadError when the folder that is named is none.
std::vector<Table> raw_gnss_tables(const std::string& folder);

}  // namespace inslab::verify
