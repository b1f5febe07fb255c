#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"

namespace inslab::imu {

/// The temperature of the sensors, deg C: straight lines between the corners of the profile, constant before the first
/// and after the last, kCalibratedAt without any. What depends on it is set as change per degree above kCalibratedAt.
class Temperature {
 public:
  static constexpr double kCalibratedAt = 20.0;

  explicit Temperature(const std::vector<TemperaturePoint>& corners) : corners_(corners) {}

  double at(std::int64_t sim_time_ns) const {
    if (corners_.empty()) return kCalibratedAt;
    const double time_s = static_cast<double>(sim_time_ns) * 1e-9;
    const auto next = std::upper_bound(corners_.begin(), corners_.end(), time_s,
                                       [](double t, const TemperaturePoint& corner) { return t < corner.at_s; });
    if (next == corners_.begin()) return corners_.front().temperature_deg_c;
    const TemperaturePoint& last = *(next - 1);
    if (next == corners_.end()) return last.temperature_deg_c;
    const double part = (time_s - last.at_s) / (next->at_s - last.at_s);
    return last.temperature_deg_c + part * (next->temperature_deg_c - last.temperature_deg_c);
  }

 private:
  std::vector<TemperaturePoint> corners_;
};

}  // namespace inslab::imu
