#pragma once

#include <cstdint>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/foundation/time/course.hpp"

namespace inslab::imu {

/// The temperature of the sensors, deg C, kCalibratedAt where the profile has none. What depends on it is set as change
/// per degree above kCalibratedAt.
class Temperature {
 public:
  static constexpr double kCalibratedAt = 20.0;

  explicit Temperature(const std::vector<TemperaturePoint>& points) : course_(corners_of(points), kCalibratedAt) {}

  double at(std::int64_t sim_time_ns) const { return course_.at(sim_time_ns); }

 private:
  static std::vector<time::Course<double>::Corner> corners_of(const std::vector<TemperaturePoint>& points) {
    std::vector<time::Course<double>::Corner> corners;
    for (const TemperaturePoint& point : points) corners.push_back({point.at_s, point.temperature_deg_c});
    return corners;
  }

  time::Course<double> course_;
};

}  // namespace inslab::imu
