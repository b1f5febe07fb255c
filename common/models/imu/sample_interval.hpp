#pragma once

#include <cstdint>

namespace inslab::imu {

/// Which interval of an IMU, and its length. Random processes step once an interval; what adds up over time, and what
/// depends on the mean rate in the interval, takes its true length, which differs by a nanosecond from one interval to
/// the next where the period is no whole number of them.
struct SampleInterval {
  std::uint64_t k = 0;
  double dt_s = 0.0;
  double stretch = 1.0;  ///< dt_s over the mean interval; exactly 1 where all are equal
};

}  // namespace inslab::imu
