#include "inslab/models/air_data/turbulence_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace inslab::air_data {
namespace {

constexpr double kFootM = 0.3048;
constexpr double kKnotMPerS = 1852.0 / 3600.0;
constexpr double kLowFt = 1000.0;   ///< up to here the laws of low altitude
constexpr double kHighFt = 2000.0;  ///< and from here those of medium and high altitude

/// W_20, kt.
double wind_at_20_ft_kt(Turbulence turbulence) { return 15.0 * static_cast<double>(turbulence); }

/// Figure 7, ft/s over ft.
constexpr std::size_t kHeights = 12;
constexpr std::array<double, kHeights> kHeightsFt{500.0,   1750.0,  3750.0,  7500.0,  15000.0, 25000.0,
                                                  35000.0, 45000.0, 55000.0, 65000.0, 75000.0, 80000.0};
constexpr std::array<double, kHeights> kLight{6.6, 6.9, 7.4, 6.7, 4.6, 2.7, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0};
constexpr std::array<double, kHeights> kModerate{8.6, 9.6, 10.6, 10.1, 8.0, 6.6, 5.0, 4.2, 2.7, 0.0, 0.0, 0.0};
constexpr std::array<double, kHeights> kSevere{15.6, 17.6, 23.0, 23.6, 22.1, 20.0, 16.0, 15.1, 12.1, 7.9, 6.2, 5.1};

double high_altitude_sigma_ft_per_s(Turbulence turbulence, double height_ft) {
  if (turbulence == Turbulence::None) return 0.0;
  const auto& sigma = turbulence == Turbulence::Light      ? kLight
                      : turbulence == Turbulence::Moderate ? kModerate
                                                           : kSevere;
  const auto above = std::upper_bound(kHeightsFt.begin(), kHeightsFt.end(), height_ft);
  if (above == kHeightsFt.begin()) return sigma.front();
  if (above == kHeightsFt.end()) return sigma.back();
  const auto i = static_cast<std::size_t>(above - kHeightsFt.begin());
  const double part = (height_ft - kHeightsFt[i - 1]) / (kHeightsFt[i] - kHeightsFt[i - 1]);
  return sigma[i - 1] + part * (sigma[i] - sigma[i - 1]);
}

TurbulenceScales low_altitude(Turbulence turbulence, double height_ft) {
  const double shape = 0.177 + 0.000823 * height_ft;
  const double level_m = kFootM * height_ft / std::pow(shape, 1.2);
  const double sigma_w = 0.1 * kKnotMPerS * wind_at_20_ft_kt(turbulence);
  const double sigma_u = sigma_w / std::pow(shape, 0.4);
  return {{level_m, level_m, kFootM * height_ft}, {sigma_u, sigma_u, sigma_w}};
}

TurbulenceScales high_altitude(Turbulence turbulence, double height_ft) {
  constexpr double kLengthFt = 1750.0;
  return {Vector3::Constant(kFootM * kLengthFt),
          Vector3::Constant(kFootM * high_altitude_sigma_ft_per_s(turbulence, height_ft))};
}

}  // namespace

TurbulenceScales turbulence_scales(Turbulence turbulence, double height_above_ground_m) {
  constexpr double kLowestFt = 10.0;
  const double height_ft = std::max(kLowestFt, height_above_ground_m / kFootM);
  if (height_ft <= kLowFt) return low_altitude(turbulence, height_ft);
  if (height_ft >= kHighFt) return high_altitude(turbulence, height_ft);
  const TurbulenceScales low = low_altitude(turbulence, kLowFt);
  const TurbulenceScales high = high_altitude(turbulence, kHighFt);
  const double part = (height_ft - kLowFt) / (kHighFt - kLowFt);
  return {low.length_m + part * (high.length_m - low.length_m),
          low.sigma_m_per_s + part * (high.sigma_m_per_s - low.sigma_m_per_s)};
}

}  // namespace inslab::air_data
