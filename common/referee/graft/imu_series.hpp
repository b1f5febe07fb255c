#pragma once

#include <cstdint>
#include <string>

#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/formats/recordings/imu_recording.hpp"

namespace inslab::graft {

/// A recording of an IMU in memory, all six axes without a gap.
struct ImuSeries {
  RecordedErrors increments;  ///< as they were measured: errors and motion
  std::int64_t first_ns = 0;  ///< the end of the first interval, as the file has it
  std::string kind;           ///< for people
};

/// Throws files::ReadError: what recordings::read_imu_recording() refuses, an axis that is missing, more than
/// files::kMaxRowsInMemory samples.
ImuSeries read_imu_series(const std::string& path, const recordings::ImuRecordingOptions& options);

/// The rate of which 1/dt_s is the measured one: whole hertz where they are within 1e-4, as far as an oscillator is
/// off.
time::Rate nominal_rate(double dt_s);

}  // namespace inslab::graft
