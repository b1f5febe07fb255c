#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/referee/calibrate/static_alignment.hpp"

namespace inslab::calibrate {

struct RecordingOptions {
  double latitude_deg = 0.0;
  double height_m = 0.0;
  nav::AlignmentLimits limits;
  novatel::NovatelImuReader::Options novatel;
  std::uint32_t sensor_number = 0;            ///< of a log of ours
  std::optional<double> gyro_bias_deg_per_h;  ///< standard deviation, if it is known
};

struct AlignedRecording {
  AlignmentResult alignment;
  double dt_s = 0.0;
  std::vector<novatel::BadLine> bad_lines;  ///< of a NovAtel log, the first ones
  std::uint64_t bad_line_count = 0;
};

/// Aligns a NovAtel ASCII log (its first line begins with # or % and has a semicolon), or what
/// recordings::read_imu_recording() takes. Throws files::ReadError naming file and place, also when nothing in the file
/// is a good IMU sample; std::invalid_argument for an IMU type that is not known.
AlignedRecording align_recording(const std::string& path, const RecordingOptions& options);

}  // namespace inslab::calibrate
