#pragma once

#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::satellites {

/// What satellites broadcast.
struct BroadcastEphemerides {
  std::vector<KeplerianEphemeris> keplerian;
  std::vector<GlonassEphemeris> glonass;
};

/// The nominal constellation at any date, written as the messages that are broadcast at `start`: no file, no download.
///
/// GPS and Galileo 24 each on their published slots (nominal_slots.hpp), BeiDou-3 24 on Walker 24/3/1 (55 deg, 27 906
/// km), three inclined ones over 118 E and geostationary ones over 80, 110.5 and 140 E, GLONASS 24/3/1 (64.8 deg,
/// 11 h 15 min 44 s, the channels of its slots), QZSS three over 135 E (e 0.075, 41 deg) and one geostationary over
/// 127 E. Where a phase is not published it is ours. Eccentricities (to 0.01 of GPS, 3e-4 of the others), clocks (3e-4
/// s, 5e-12), delays (10 ns) and harmonics are drawn from the streams sky/G01/record of the seed, so that no term is 0
/// by accident. Satellites do not depend on each other.
BroadcastEphemerides nominal_constellation(std::uint64_t seed, const time::GpsTime& start);

}  // namespace inslab::satellites
