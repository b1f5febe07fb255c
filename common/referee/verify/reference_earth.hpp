#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

/// The ellipsoid and its gravity in extended precision, written again from their source: what the references of the
/// verification stand on instead of common/nav.
namespace inslab::verify {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;

namespace reference_earth {

inline constexpr Real kPi = 3.14159265358979323846264338327950288L;
inline constexpr Real kA_m = 6378137.0L, kF = 1.0L / 298.257223563L, kE2 = kF * (2.0L - kF);
inline constexpr Real kOmega_rad_per_s = 7.292115e-5L;

/// Radii of curvature, m, by the sine of the latitude.
inline Real transverse_m(Real s) { return kA_m / std::sqrt(1 - kE2 * s * s); }
inline Real meridian_m(Real s) {
  const Real W2 = 1 - kE2 * s * s;
  return kA_m * (1 - kE2) / (W2 * std::sqrt(W2));
}

/// TR8350.2 (4-1), (4-3), m/s^2.
inline Real gravity_m_per_s2(Real s, Real height_m) {
  const Real x = height_m / kA_m;
  return 9.7803253359L * (1 + 0.00193185265241L * s * s) / std::sqrt(1 - kE2 * s * s) *
         (1 - 2 * (1 + kF + 0.00344978650684L - 2 * kF * s * s) * x + 3 * x * x);
}

inline RealVector ecef_m(Real latitude, Real longitude, Real height) {
  const Real N = transverse_m(std::sin(latitude));
  return {(N + height) * std::cos(latitude) * std::cos(longitude),
          (N + height) * std::cos(latitude) * std::sin(longitude), (N * (1 - kE2) + height) * std::sin(latitude)};
}

/// Latitude by fixed-point iteration, which contracts by e2 a round: 9 rounds leave 1e-20.
inline std::array<Real, 3> geodetic(const RealVector& r) {
  const Real p = std::sqrt(r.x() * r.x() + r.y() * r.y());
  Real latitude = std::atan2(r.z(), p * (1 - kE2)), N = kA_m, height = 0;
  for (int i = 0; i < 9; ++i) {
    N = transverse_m(std::sin(latitude));
    height = p / std::cos(latitude) - N;
    latitude = std::atan2(r.z(), p * (1 - kE2 * N / (N + height)));
  }
  return {latitude, std::atan2(r.y(), r.x()), height};
}

/// Takes north, east, down at a place to e.
inline RealMatrix C_en(Real latitude, Real longitude) {
  const Real s = std::sin(latitude), c = std::cos(latitude), sl = std::sin(longitude), cl = std::cos(longitude);
  RealMatrix C;
  C << -s * cl, -sl, -c * cl, -s * sl, cl, -c * sl, c, 0, -s;
  return C;
}

}  // namespace reference_earth
}  // namespace inslab::verify
