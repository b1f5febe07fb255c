#include "inslab/referee/graft/imu_series.hpp"

#include <cmath>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"

namespace inslab::graft {

time::Rate nominal_rate(double dt_s) {
  constexpr double kOscillator = 1e-4;
  const double hz = 1.0 / dt_s;
  const double whole = std::round(hz);
  return time::Rate(whole >= 1.0 && std::abs(hz - whole) < kOscillator * whole ? whole : hz);
}

ImuSeries read_imu_series(const std::string& path, const recordings::ImuRecordingOptions& options) {
  ImuSeries series;
  const auto info = recordings::read_imu_recording(
      path, options,
      [&](const recordings::ImuRecordingInfo& begun) {
        for (std::size_t axis = 0; axis < recordings::kImuAxes; ++axis) {
          if (begun.has_axis[axis]) continue;
          throw files::ReadError(path + ": has no " + recordings::kImuAxisNames[axis] +
                                 "; grafting needs all six axes");
        }
        series.increments.rate = nominal_rate(begun.dt_s);
      },
      [&](const recordings::ImuIncrements& increments) {
        if (series.increments.intervals.size() == files::kMaxRowsInMemory) {
          throw files::ReadError(path + ": has more than " + std::to_string(files::kMaxRowsInMemory) + " samples");
        }
        series.increments.intervals.push_back(increments);
      });
  series.first_ns = info.first_ns;
  series.kind = info.kind;
  return series;
}

}  // namespace inslab::graft
