#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

/// What lines of RINEX and SP3 are made of: fields by their columns.
namespace inslab::rinex {

/// `width` columns from `begin` (from 0), without spaces at both ends; empty where the line is shorter.
std::string_view field_at(std::string_view line, std::size_t begin, std::size_t width);

/// The label of a header line: what stands from column 60 on.
inline std::string_view label_of(std::string_view line) { return field_at(line, 60, 20); }

/// A number as Fortran writes it: the exponent may be D. Nothing when the text is none.
std::optional<double> fortran_number(std::string_view text);

/// "G01", "G 1"; nothing when it is none of the systems of GnssSystem. A blank system is `of_blank`'s.
std::optional<SatelliteId> satellite_from(std::string_view text, std::optional<GnssSystem> of_blank = {});

/// Year, month, day, hour, minute and second as they stand between spaces, in GPS time; years below 80 are of this
/// century, those below 100 of the last. Nothing when they are none.
std::optional<time::GpsTime> calendar_from(std::string_view text);

/// The GPS time of a calendar in UTC that calendar_from() took for GPS time.
time::GpsTime from_utc(const time::GpsTime& calendar);

}  // namespace inslab::rinex
