#include "inslab/models/atmosphere/saastamoinen.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::atmosphere {

ZenithDelay saastamoinen_zenith(const nav::Geodetic& antenna, double relative_humidity) {
  constexpr double kLowest_m = -100.0, kHighest_m = 10000.0;
  if (antenna.height_m < kLowest_m || antenna.height_m > kHighest_m) return {};
  const double height_m = std::max(0.0, antenna.height_m);
  const double pressure_hpa = 1013.25 * std::pow(1.0 - 2.2557e-5 * height_m, 5.2568);
  const double temperature_k = 288.16 - 6.5e-3 * height_m;
  const double vapour_hpa =
      6.108 * relative_humidity * std::exp((17.15 * temperature_k - 4684.0) / (temperature_k - 38.45));
  const double gravity = 1.0 - 0.00266 * std::cos(2.0 * antenna.latitude_rad) - 0.00028 * height_m / 1000.0;
  return {0.0022768 * pressure_hpa / gravity, 0.002277 * (1255.0 / temperature_k + 0.05) * vapour_hpa};
}

double saastamoinen_cosecant_m(const nav::Geodetic& antenna, double elevation_rad, double relative_humidity) {
  if (elevation_rad <= 0.0) return 0.0;
  const ZenithDelay zenith = saastamoinen_zenith(antenna, relative_humidity);
  return (zenith.dry_m + zenith.wet_m) / std::sin(elevation_rad);
}

}  // namespace inslab::atmosphere
