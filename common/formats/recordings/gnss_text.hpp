#pragma once

#include "inslab/foundation/files/number_line.hpp"
#include "inslab/foundation/files/text_writer.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::recordings {

/// One position fix of a receiver's antenna.
struct GnssTextRecord {
  time::Nanoseconds in_week{0};  ///< GPS time from the beginning of a week; read: of the first line's
  nav::Geodetic position;
  nav::Vector3 sigma_ned_m;
};

/// Writes the 7-column GNSS text: seconds of week, latitude deg, longitude deg, height m, standard deviations north,
/// east, down m. Decimals: 9 of seconds, 12 of latitude and longitude, 6 of height and of the standard deviations.
class GnssTextWriter {
 public:
  /// Throws WriteError.
  explicit GnssTextWriter(const std::string& path) : out_(path, " ") {}
  /// Throws WriteError.
  void write(const GnssTextRecord& record);
  void close() { out_.close(); }

 private:
  files::TextWriter out_;
};

/// Reads what GnssTextWriter writes, line by line; lines that are empty or begin with # or % are comments.
class GnssTextReader {
 public:
  /// Throws ReadError when the file cannot be opened.
  explicit GnssTextReader(const std::string& path) : lines_(path) {}
  /// The next record; false at the end. Throws ReadError, naming file, line and what was expected, for a line that is
  /// not 7 finite numbers, seconds outside a week or not after those of the line before, a position outside
  /// the valid domain, or a standard deviation that is not above 0.
  bool next(GnssTextRecord& record);

 private:
  files::TextLines lines_;
  files::SecondsOfWeek time_;
};

}  // namespace inslab::recordings
