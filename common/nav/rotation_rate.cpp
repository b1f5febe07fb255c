#include "nav/rotation_rate.hpp"

#include <cmath>

namespace inslab::nav {

namespace {

// Below this angle squared the series are exact to rounding: the terms left out are below phi^6/1e5 = 1e-17.
constexpr double kSmall_rad2 = 1e-4;

}  // namespace

Vector3 rate_from_rotation_vector(const Vector3& Phi, const Vector3& Phi_rate) {
  const double phi2 = Phi.squaredNorm();
  double first, second;  // (1 - cos phi)/phi^2 and (phi - sin phi)/phi^3
  if (phi2 < kSmall_rad2) {
    first = 0.5 - phi2 / 24.0 * (1.0 - phi2 / 30.0);
    second = 1.0 / 6.0 - phi2 / 120.0 * (1.0 - phi2 / 42.0);
  } else {
    const double phi = std::sqrt(phi2);
    const double half = std::sin(0.5 * phi);
    first = 2.0 * half * half / phi2;
    second = (phi - std::sin(phi)) / (phi2 * phi);
  }
  const Vector3 turned = Phi.cross(Phi_rate);
  return Phi_rate - first * turned + second * Phi.cross(turned);
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
