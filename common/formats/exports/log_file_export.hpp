#pragma once

#include <cstdint>
#include <string>

#include "inslab/formats/novatel/novatel_imu.hpp"

namespace inslab::exports {

/// The formats in which one topic of a log becomes one file.
enum class FileFormat {
  Nav,      ///< the 11-column text (formats/recordings/nav_text.hpp), of the truth or a navigation solution
  Imu,      ///< the 7-column IMU text (formats/recordings/imu_text.hpp)
  Gnss,     ///< the 7-column GNSS text (formats/recordings/gnss_text.hpp)
  Kml,      ///< a track for a globe (formats/recordings/kml.hpp), of the truth or a navigation solution
  Novatel,  ///< RAWIMUSXA lines (formats/novatel/novatel_imu.hpp)
};

struct FileExportOptions {
  FileFormat format = FileFormat::Nav;
  std::string destination;
  /// Empty: inslab/truth for Nav and Kml; for the others the only IMU or receiver.
  std::string topic;
  std::uint32_t novatel_imu_type = 26;  ///< ISA100C: 1e-9 rad and 2e-8 m/s a count
  novatel::NovatelAxes novatel_axes = novatel::NovatelAxes::RightForwardUp;
};

struct ExportedFile {
  std::string topic;
  std::uint64_t rows = 0;
  /// Samples that hold nothing for the format: no fix, no solution yet, no interval before the first sample.
  std::uint64_t left_out = 0;
  std::uint64_t unreadable = 0;  ///< messages that are not what their type says
};

/// Writes a topic of a log as one file. Throws ReadError, also when the log has no such topic or more than one to
/// choose from, WriteError, std::invalid_argument for an unknown IMU type and std::range_error for an increment that
/// its counts cannot hold.
ExportedFile export_file(const std::string& log, const FileExportOptions& options);

}  // namespace inslab::exports
