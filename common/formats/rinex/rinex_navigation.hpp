#pragma once

#include <optional>
#include <string>

#include "inslab/data/samples/broadcast_ionosphere.hpp"
#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::rinex {

/// An ephemeris and the line of the file that it begins in.
template <class Ephemeris>
struct NavigationRecord {
  Ephemeris ephemeris;
  std::uint64_t line = 0;
};

/// What a navigation file says.
struct NavigationFile {
  std::string path;
  double version = 0.0;
  std::vector<NavigationRecord<KeplerianEphemeris>> keplerian;
  std::vector<NavigationRecord<GlonassEphemeris>> glonass;
  std::vector<BroadcastIonosphere> ionosphere;
  std::uint64_t empty_records = 0;  ///< all zeros: written before the message had been heard
  std::uint64_t other_records = 0;  ///< of SBAS and NavIC, of messages that are not simulated, of RINEX 4's STO and EOP
};

/// Reads a RINEX navigation file: 2.10 to 2.11 of GPS or GLONASS, 3.00 to 3.05, and of 4.00 the messages LNAV, INAV,
/// FNAV, D1, D2, FDMA and Klobuchar's ionosphere. A record goes as far as its lines do, however many its version has;
/// exponents are D or E. The week of toe is the one nearest to toc. Throws files::ReadError, naming the file, the line
/// and what was expected: a header that is none, a record that breaks off, a number that is none.
NavigationFile read_navigation(const std::string& path);

}  // namespace inslab::rinex
