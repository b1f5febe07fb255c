#include "inslab/models/trajectory/spin.hpp"

#include <array>
#include <cmath>

namespace inslab::trajectory {

namespace {

/// Gauss-Legendre's rule of five points on [-1, 1]: nodes and weights.
/// Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), table 25.4.
struct GaussNode {
  double at;
  double weight;
};
constexpr std::array<GaussNode, 5> kGauss{{{0.0, 0.568888888888888889},
                                           {-0.538469310105683091, 0.478628670499366468},
                                           {0.538469310105683091, 0.478628670499366468},
                                           {-0.906179845938663993, 0.236926885056189088},
                                           {0.906179845938663993, 0.236926885056189088}}};
constexpr double kLongestPiece_rad = 1.0;

}  // namespace

double Spin::rate_rad_per_s(double t_s) const {
  return decay_s_ == 0.0 ? rate_rad_per_s_ : rate_rad_per_s_ * std::exp(-t_s / decay_s_);
}

double Spin::turned_rad(double t_s, double dt_s) const {
  return decay_s_ == 0.0 ? rate_rad_per_s_ * dt_s : -rate_rad_per_s(t_s) * decay_s_ * std::expm1(-dt_s / decay_s_);
}

Vector3 Spin::integral_in_spinning_axes(const Vector3& along, const Vector3& start, const Vector3& middle,
                                        const Vector3& end, double t0_s, double dt_s) const {
  const double pieces = std::ceil(std::abs(turned_rad(t0_s, dt_s)) / kLongestPiece_rad);
  const double half_s = 0.5 * dt_s / pieces;
  const Vector3 slope = end - start, bend = 2.0 * (start - 2.0 * middle + end);
  Vector3 sum = Vector3::Zero();
  for (double piece = 0.0; piece < pieces; ++piece) {
    for (const GaussNode& node : kGauss) {
      const double since_s = half_s * (2.0 * piece + 1.0 + node.at);
      const double share = since_s / dt_s;
      const Vector3 value = start + share * (slope + (share - 1.0) * bend);
      const Vector3 across = value - along.dot(value) * along;
      const double angle_rad_now = angle_rad(t0_s + since_s);
      sum += half_s * node.weight * (std::cos(angle_rad_now) * across - std::sin(angle_rad_now) * along.cross(across));
    }
  }
  const double parallel = along.dot(start + 4.0 * middle + end) * dt_s / 6.0;
  return parallel * along + sum;
}

}  // namespace inslab::trajectory
