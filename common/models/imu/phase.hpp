#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>

#include "inslab/foundation/units/units.hpp"

/// Phases and integrals of sinusoids of sim time.
namespace inslab::imu {

/// f * t less whole turns, t in units of half a nanosecond: the middle of an interval is always a whole number of them.
/// The whole turns are taken off exactly, so a phase is as good after a week as at the start.
inline double turns(double frequency_hz, std::int64_t time_half_ns) {
  constexpr std::int64_t kHalfNsPerS = 2000000000;
  const auto [quotient, remainder] = std::lldiv(time_half_ns, kHalfNsPerS);
  const auto whole_s = static_cast<double>(quotient);
  const double rest_s = static_cast<double>(remainder) * 0.5e-9;
  const double product = frequency_hz * whole_s;
  const double rounding = std::fma(frequency_hz, whole_s, -product);  // exact
  return (product - std::floor(product)) + rounding + frequency_hz * rest_s;
}

/// Integral of cos(2 pi f t) over -dt/2..dt/2, s.
inline double gain_s(double frequency_hz, double dt_s) {
  const double x = units::kPi * frequency_hz * dt_s;
  return std::abs(x) < 1e-8 ? dt_s : dt_s * std::sin(x) / x;
}

/// exp(2 pi i turns)
inline std::complex<double> phasor(double turns) {
  const double angle = 2.0 * units::kPi * turns;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace inslab::imu
