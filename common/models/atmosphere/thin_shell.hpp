#pragma once

#include <array>
#include <cstdint>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/geodesy.hpp"

/// An ionosphere of a thin shell, the same for every receiver: what it is at a place and an instant depends on nothing
/// else.
namespace inslab::atmosphere {

/// Electrons of a column, in TECU: 1e16 per m^2.
struct ThinShellParameters {
  nav::Geodetic middle;               ///< where gradients and waves are reckoned from
  double night_tecu = 5.0;            ///< everywhere at night
  double day_tecu = 20.0;             ///< more than that at two in the afternoon
  double north_tecu_per_100km = 0.0;  ///< gradient
  double east_tecu_per_100km = 0.0;
  double waves_tecu = 0.0;  ///< RMS of the travelling disturbances
};

/// Height of the shell, and the radius of the Earth below it, m.
inline constexpr double kShellHeight_m = 450e3;
inline constexpr double kShellEarth_m = 6371e3;

/// Where a line of sight goes through the shell, on a sphere; and how much longer than vertical its way there is.
struct PiercePoint {
  double latitude_rad = 0.0, longitude_rad = 0.0;
  double obliquity = 1.0;  ///< 1 / sqrt(1 - (R cos E / (R + h))^2)
};
PiercePoint pierce_point(const nav::Geodetic& antenna, double azimuth_rad, double elevation_rad);

/// The delay of the code at a frequency, m, of that many TECU; the phase is early by as much.
constexpr double ionosphere_delay_m(double tecu, double frequency_hz) {
  return 40.308e16 * tecu / (frequency_hz * frequency_hz);
}

class ThinShell {
 public:
  /// Waves are drawn from the streams sky/iono/0 to sky/iono/31 of the seed and begin their course at `begin`.
  ThinShell(std::uint64_t seed, const ThinShellParameters& parameters, const time::GpsTime& begin);

  /// Above a place: a bulge about 14:00 local time (half a cosine of 28 h, as Klobuchar's), the gradient, and 32 plane
  /// waves of 50 to 500 km and 100 to 300 m/s.
  double vertical_tecu(double latitude_rad, double longitude_rad, const time::GpsTime& gps) const;

  /// Along a line of sight.
  double slant_tecu(const nav::Geodetic& antenna, double azimuth_rad, double elevation_rad,
                    const time::GpsTime& gps) const;

 private:
  struct Wave {
    double north_rad_per_m, east_rad_per_m, rate_rad_per_s, phase_rad;
  };

  ThinShellParameters parameters_;
  time::GpsTime begin_;
  std::array<Wave, 32> waves_;
};

}  // namespace inslab::atmosphere
