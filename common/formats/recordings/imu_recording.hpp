#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace inslab::recordings {

/// What a recording of an IMU may hold: gyros x y z, then accelerometers x y z.
inline constexpr std::size_t kImuAxes = 6;
inline constexpr const char* kImuAxisNames[kImuAxes] = {"gyro x", "gyro y", "gyro z", "accel x", "accel y", "accel z"};

/// Increments of one sample interval, rad and m/s; those of axes that the recording lacks are 0.
using ImuIncrements = std::array<double, kImuAxes>;

/// How a recording is to be read.
struct ImuRecordingOptions {
  std::uint32_t sensor_number = 0;  ///< of a log: inslab/imu/N
  bool minus_truth = false;         ///< of a log: less inslab/imu_truth/N, so that only the errors are left
  bool over_gaps = false;           ///< samples missing: go on as though the ones beside them were neighbours
};

struct ImuRecordingInfo {
  std::string kind;           ///< for people: "log, inslab/imu/0", ...
  std::int64_t first_ns = 0;  ///< time of the first sample as the file has it; of a log in the GPS week
  double dt_s = 0.0;          ///< the usual interval: the median of the first thousand
  std::array<bool, kImuAxes> has_axis{};
  std::uint64_t samples = 0;
  std::uint64_t gaps = 0;     ///< intervals that are more than half of dt off
  std::uint64_t invalid = 0;  ///< samples of a log that say themselves that they are not valid: left out as gaps
};

/// Reads a recording from the beginning to the end, never the whole of it in memory. `begin` is called once, with
/// everything but the counts, before the first `sample`.
///
/// A file is taken for
///  - a log of ours (MCAP): the topics that `options` name;
///  - a text of 7 columns without names, spaces or commas between: seconds, dtheta x y z rad, dv x y z m/s;
///  - a CSV with a line of names: a time (time_s, time_ms, time_us, time_ns, header.sim_time_ns) and any of the axes as
///    gyro_x_rad_per_s (_deg_per_s, _deg_per_h), accel_x_m_per_s2 (_g, _mgal), dtheta_x_rad (_deg, _arcsec),
///    dv_x_m_per_s, or as our CSV export names them (dtheta_b_rad.x, dv_b_m_per_s.x). Rates are multiplied by dt.
///    Other columns are passed over.
/// Throws ReadError naming file, line or sample, and what was expected: no such topic, no known column, a number that
/// is none, times that do not increase, fewer than three samples, and gaps unless `over_gaps`.
ImuRecordingInfo read_imu_recording(const std::string& path, const ImuRecordingOptions& options,
                                    const std::function<void(const ImuRecordingInfo&)>& begin,
                                    const std::function<void(const ImuIncrements&)>& sample);

}  // namespace inslab::recordings
