#include "inslab/models/atmosphere/klobuchar.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::atmosphere {

namespace {

double cubic(const std::array<double, 4>& c, double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }

}  // namespace

double klobuchar_delay_s(const BroadcastIonosphere& broadcast, const nav::Geodetic& antenna, double azimuth_rad,
                         double elevation_rad, const time::GpsTime& gps) {
  // Angles in semicircles, as the ICD reckons.
  constexpr double kDay_s = 86400.0, kNoon_s = 50400.0, kNight_s = 5e-9, kLeastPeriod_s = 72000.0;
  const double elevation = elevation_rad / units::kPi;
  const double psi = 0.0137 / (elevation + 0.11) - 0.022;
  const double latitude = std::clamp(antenna.latitude_rad / units::kPi + psi * std::cos(azimuth_rad), -0.416, 0.416);
  const double longitude =
      antenna.longitude_rad / units::kPi + psi * std::sin(azimuth_rad) / std::cos(latitude * units::kPi);
  const double geomagnetic = latitude + 0.064 * std::cos((longitude - 1.617) * units::kPi);

  double local_s = std::fmod(43200.0 * longitude + time::to_seconds(gps.time_of_week_ns), kDay_s);
  if (local_s < 0.0) local_s += kDay_s;
  const double amplitude_s = std::max(0.0, cubic(broadcast.alpha, geomagnetic));
  const double period_s = std::max(kLeastPeriod_s, cubic(broadcast.beta, geomagnetic));
  const double x = 2.0 * units::kPi * (local_s - kNoon_s) / period_s;
  const double slant = 1.0 + 16.0 * std::pow(0.53 - elevation, 3);
  const double bulge_s = std::abs(x) < 1.57 ? amplitude_s * (1.0 - x * x / 2.0 + x * x * x * x / 24.0) : 0.0;
  return slant * (kNight_s + bulge_s);
}

}  // namespace inslab::atmosphere
