#include "inslab/nav/rotation_rate.hpp"

#include <cmath>

#include "inslab/nav/rotation_spline.hpp"

namespace inslab::nav {

namespace {

// Below this angle squared the series is exact to rounding: the term left out is phi^6/1.2e6 = 1e-18.
constexpr double kSmall_rad2 = 1e-4;

}  // namespace

Vector3 rate_from_rotation_vector(const Vector3& Phi, const Vector3& Phi_rate) {
  return rate_from_rotation_vector(RotationFactors(Phi.squaredNorm()), Phi, Phi_rate);
}

Vector3 rotation_vector_rate(const Vector3& Phi, const Vector3& omega) {
  const double phi2 = Phi.squaredNorm();
  double factor;  // (1 - phi/2 cot(phi/2))/phi^2
  if (phi2 < kSmall_rad2) {
    factor = 1.0 / 12.0 + phi2 / 720.0 * (1.0 + phi2 / 42.0);
  } else {
    const double half = 0.5 * std::sqrt(phi2);
    factor = (1.0 - half * std::cos(half) / std::sin(half)) / phi2;
  }
  const Vector3 turned = Phi.cross(omega);
  return omega + 0.5 * turned + factor * Phi.cross(turned);
}

}  // namespace inslab::nav
