#include "inslab/models/atmosphere/thin_shell.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::atmosphere {

PiercePoint pierce_point(const nav::Geodetic& antenna, double azimuth_rad, double elevation_rad) {
  const double ratio = kShellEarth_m / (kShellEarth_m + kShellHeight_m) * std::cos(elevation_rad);
  const double psi = 0.5 * units::kPi - elevation_rad - std::asin(ratio);  // between antenna and point, seen from below
  const double sin_psi = std::sin(psi), cos_psi = std::cos(psi);
  const double sin_lat = std::sin(antenna.latitude_rad), cos_lat = std::cos(antenna.latitude_rad);
  const double north = sin_psi * std::cos(azimuth_rad);
  return {std::asin(sin_lat * cos_psi + cos_lat * north),
          nav::wrapped_to_pi(antenna.longitude_rad +
                             std::atan2(sin_psi * std::sin(azimuth_rad), cos_lat * cos_psi - sin_lat * north)),
          1.0 / std::sqrt(1.0 - ratio * ratio)};
}

ThinShell::ThinShell(std::uint64_t seed, const ThinShellParameters& parameters, const time::GpsTime& begin)
    : parameters_(parameters), begin_(begin) {
  constexpr double kShortest_m = 50e3, kLongest_m = 500e3, kSlowest = 100.0, kFastest = 300.0;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const random::Stream drawn(seed, "sky/iono/" + std::to_string(i));
    const double length_m = kShortest_m * std::pow(kLongest_m / kShortest_m, drawn.uniform(0));
    const double speed_m_per_s = kSlowest + (kFastest - kSlowest) * drawn.uniform(1);
    const double course_rad = 2.0 * units::kPi * drawn.uniform(2);
    const double number = 2.0 * units::kPi / length_m;
    waves_[i] = {number * std::cos(course_rad), number * std::sin(course_rad), number * speed_m_per_s,
                 2.0 * units::kPi * drawn.uniform(3)};
  }
}

double ThinShell::vertical_tecu(double latitude_rad, double longitude_rad, const time::GpsTime& gps) const {
  constexpr double kDay_h = 24.0, kNoon_h = 14.0, kPeriod_h = 28.0;
  const double hours = time::to_seconds(gps.time_of_week_ns) / 3600.0 + longitude_rad / units::kPi * 12.0;
  const double from_noon_h = std::remainder(hours - kNoon_h, kDay_h);
  const double bulge = std::max(0.0, std::cos(2.0 * units::kPi * from_noon_h / kPeriod_h));

  const nav::Geodetic& middle = parameters_.middle;
  const double north_m = kShellEarth_m * (latitude_rad - middle.latitude_rad);
  const double east_m =
      kShellEarth_m * std::cos(middle.latitude_rad) * nav::wrapped_to_pi(longitude_rad - middle.longitude_rad);
  double tecu = parameters_.night_tecu + parameters_.day_tecu * bulge +
                1e-5 * (parameters_.north_tecu_per_100km * north_m + parameters_.east_tecu_per_100km * east_m);
  if (parameters_.waves_tecu != 0.0) {
    const double t_s = time::to_seconds(gps - begin_);
    double sum = 0.0;
    for (const Wave& wave : waves_) {
      sum += std::cos(wave.north_rad_per_m * north_m + wave.east_rad_per_m * east_m - wave.rate_rad_per_s * t_s +
                      wave.phase_rad);
    }
    tecu += parameters_.waves_tecu * std::sqrt(2.0 / static_cast<double>(waves_.size())) * sum;
  }
  return std::max(0.0, tecu);
}

double ThinShell::slant_tecu(const nav::Geodetic& antenna, double azimuth_rad, double elevation_rad,
                             const time::GpsTime& gps) const {
  const PiercePoint point = pierce_point(antenna, azimuth_rad, elevation_rad);
  return point.obliquity * vertical_tecu(point.latitude_rad, point.longitude_rad, gps);
}

}  // namespace inslab::atmosphere
