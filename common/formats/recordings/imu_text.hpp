#pragma once

#include "inslab/foundation/files/number_line.hpp"
#include "inslab/foundation/files/text_writer.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::recordings {

/// One sample of an IMU: increments over the interval that ends at `in_week`, forward-right-down.
struct ImuTextRecord {
  time::Nanoseconds in_week{0};  ///< GPS time from the beginning of a week; read: of the first line's
  nav::Vector3 dtheta_b;         ///< rad
  nav::Vector3 dv_b;             ///< m/s
};

/// Writes the 7-column IMU text: seconds of week, dtheta x y z rad, dv x y z m/s. Decimals: 9 of seconds, 15 of dtheta,
/// 12 of dv.
class ImuTextWriter {
 public:
  /// Throws WriteError.
  explicit ImuTextWriter(const std::string& path) : out_(path, " ") {}
  /// Throws WriteError.
  void write(const ImuTextRecord& record);
  void close() { out_.close(); }

 private:
  files::TextWriter out_;
};

/// Reads what ImuTextWriter writes, line by line; lines that are empty or begin with # or % are comments.
class ImuTextReader {
 public:
  /// Throws ReadError when the file cannot be opened.
  explicit ImuTextReader(const std::string& path) : lines_(path) {}
  /// The next record; false at the end. Throws ReadError, naming file, line and column, for a line that is not 7 finite
  /// numbers with the seconds in a week and after those of the line before.
  bool next(ImuTextRecord& record);

 private:
  files::TextLines lines_;
  files::SecondsOfWeek time_;
};

}  // namespace inslab::recordings
