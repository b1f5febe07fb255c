#pragma once

#include <string>
#include <vector>

#include "inslab/formats/exports/log_file_export.hpp"

namespace inslab::exports {

/// What is to be made of a log.
struct ExportRequest {
  std::string log;
  std::string format;       ///< of export_formats()
  std::string destination;  ///< the folder or file; empty: LOG_csv, LOG.h5, LOG.nav, ... beside the log
  std::vector<std::string> topics;
  std::uint32_t novatel_imu_type = FileExportOptions{}.novatel_imu_type;
  novatel::NovatelAxes novatel_axes = novatel::NovatelAxes::RightForwardUp;
};

/// csv, hdf5, then those that make one file of one topic.
std::vector<std::string> export_formats();

/// What was made, a line each, and what had to be left out.
struct Exported {
  std::vector<std::string> made;
  std::vector<std::string> left_out;
};

/// Throws ReadError, WriteError, std::range_error, and std::invalid_argument for what cannot be asked for, such as two
/// topics in a format of one.
Exported export_as(const ExportRequest& request);

/// "17 HG1700 AG58, ...": the IMU types whose counts NovAtel lines can have.
std::string novatel_imu_types_text();

}  // namespace inslab::exports
