#pragma once

#include <algorithm>
#include <cmath>

#include "inslab/data/profiles/wind_field.hpp"

namespace inslab::air_data {

/// The mean wind over the height above the ground: straight lines between the levels of the profile, the highest above
/// them, and below the lowest, or at every height where there is one level alone,
///
///   V(h) = V_1 (h / h_1)^a
///
/// Source: MIL-HDBK-1797, 4.9.1 (the power law for the wind's profile near the ground).
inline Vector3 mean_wind_ned_m_per_s(const WindField& wind, double height_above_ground_m) {
  const auto& levels = wind.levels;
  if (levels.empty()) return Vector3::Zero();
  const double height_m = std::max(height_above_ground_m, 0.0);
  const WindLevel& lowest = levels.front();
  if (levels.size() == 1 || height_m < lowest.height_m) {
    return std::pow(height_m / lowest.height_m, wind.power_law_exponent) * lowest.wind_ned_m_per_s;
  }
  const auto above = std::find_if(levels.begin(), levels.end(),
                                  [height_m](const WindLevel& level) { return level.height_m > height_m; });
  if (above == levels.end()) return levels.back().wind_ned_m_per_s;
  const WindLevel& below = *(above - 1);
  const double part = (height_m - below.height_m) / (above->height_m - below.height_m);
  return below.wind_ned_m_per_s + part * (above->wind_ned_m_per_s - below.wind_ned_m_per_s);
}

}  // namespace inslab::air_data
