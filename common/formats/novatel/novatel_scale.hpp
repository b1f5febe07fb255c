#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace inslab::novatel {

/// What one count of an IMU type means, and how often the type samples.
struct NovatelImuType {
  std::uint32_t type;  ///< the number in RAWIMUSXA
  std::string_view name;
  double rad_per_count;
  double m_per_s_per_count;
  double rate_hz;
};

/// All types known, by number.
const std::vector<NovatelImuType>& novatel_imu_types();

/// Null when the type is not known.
const NovatelImuType* find_novatel_imu_type(std::uint32_t type);

}  // namespace inslab::novatel
