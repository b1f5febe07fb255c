#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace inslab::recordings {

/// A column of an IMU's text that says something of an axis or of the time.
struct ImuColumn {
  std::size_t place = 0;                 ///< in the line
  int axis = -1;                         ///< gyro 0 to 2, accelerometer 3 to 5; below 0: the time
  double scale = 1.0;                    ///< of an axis, to SI
  bool is_rate = false;                  ///< rad/s, m/s^2; else increments
  std::int64_t unit_ns = 1'000'000'000;  ///< of the time
};

/// What a name says, such as gyro_x_rad_per_s, dv_b_m_per_s.x, time_ns, or with its unit in brackets as other programs
/// write it: timestamp [ns], w_RS_S_x [rad s^-1], a_x (m/s^2). Nothing when it is none of them, or has no unit.
std::optional<ImuColumn> imu_column_named(std::string_view name, std::size_t place);

}  // namespace inslab::recordings
