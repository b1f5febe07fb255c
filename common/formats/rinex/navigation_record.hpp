#pragma once

#include <string>
#include <vector>

#include "inslab/formats/rinex/rinex_navigation.hpp"

namespace inslab::rinex {

/// The lines of one record of a navigation file, and where its columns are.
struct RecordLines {
  std::string path;
  std::uint64_t line = 0;  ///< of the first
  std::vector<std::string> texts;
  std::size_t indent = 4;  ///< columns before the numbers of a line: 3 in RINEX 2, 4 after it
  std::size_t calendar_begin = 4, calendar_width = 19;

  /// The number at a place, 0 to 2 behind the epoch, then four a line; nothing where it is blank or its line missing.
  /// Throws ReadError for what is no number.
  std::optional<double> at(int place) const;
  /// The same; nothing, too, for the large number that writers put where they do not know.
  std::optional<double> known_at(int place) const;
  /// As at(); throws ReadError where there is none.
  double required(int place, std::string_view name) const;
  /// A count, 0 where there is none. Throws ReadError when it is not whole or outside 0 to 2^32 - 1.
  std::uint32_t count_at(int place, std::string_view name) const;
  /// The time in front, as a calendar in GPS time.
  time::GpsTime calendar() const;
  [[noreturn]] void refuse(std::size_t line_of_record, const std::string& why) const;
};

/// Takes a record apart. `message` is what RINEX 4 names it; before it, the numbers say.
KeplerianEphemeris keplerian_from(const RecordLines& record, const SatelliteId& satellite,
                                  std::optional<KeplerianMessage> message);
GlonassEphemeris glonass_from(const RecordLines& record, const SatelliteId& satellite);
BroadcastIonosphere ionosphere_from(const RecordLines& record, GnssSystem system);

}  // namespace inslab::rinex
