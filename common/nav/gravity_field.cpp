#include "inslab/nav/gravity_field.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

constexpr double kStandardGravity_m_per_s2 = 9.80665;

/// A wave at one place, as a complex amplitude whose real part counts; a derivative multiplies it.
struct WaveThere {
  std::complex<double> potential_m_per_s2;  ///< |k| T of the wave
  std::complex<double> by_north, by_east;   ///< d/dx over |k|
  double by_down;                           ///< -d/dz over |k|
  double k_rad_per_m;

  /// x_m: north, east, up.
  WaveThere(const GravityField::Wave& wave, const Vector3& x_m)
      : k_rad_per_m(std::hypot(wave.north_rad_per_m, wave.east_rad_per_m)) {
    const double phase = wave.north_rad_per_m * x_m.x() + wave.east_rad_per_m * x_m.y() + wave.phase_rad;
    const double amplitude = kStandardGravity_m_per_s2 * wave.deflection_rad * std::exp(-k_rad_per_m * x_m.z());
    potential_m_per_s2 = std::polar(amplitude, phase);
    by_north = {0.0, wave.north_rad_per_m / k_rad_per_m};
    by_east = {0.0, wave.east_rad_per_m / k_rad_per_m};
    by_down = 1.0;
  }

  Vector3 gradient_n(const std::complex<double>& factor) const {
    const std::complex<double> there = potential_m_per_s2 * factor;
    return {(there * by_north).real(), (there * by_east).real(), (there * by_down).real()};
  }
};

constexpr int kHighest = 3;

/// Calls visit(power, north, east, up) for the exponents of every power of the place up to kHighest.
template <class Visit>
void for_each_power(Visit visit) {
  std::size_t power = 0;
  for (int north = 0; north <= kHighest; ++north) {
    for (int east = 0; north + east <= kHighest; ++east) {
      for (int up = 0; north + east + up <= kHighest; ++up) visit(power++, north, east, up);
    }
  }
}

/// x^n/n!, n = 0 .. kHighest.
template <class Number>
std::array<Number, kHighest + 1> taylor_powers(const Number& x) {
  return {Number(1.0), x, x * x / 2.0, x * x * x / 6.0};
}

}  // namespace

GravityField::GravityField(const Geodetic& origin, double cell_m, std::vector<Wave> waves)
    : origin_(origin),
      cell_m_(cell_m),
      north_m_per_rad_(wgs84::meridian_radius_from_sine_m(std::sin(origin.latitude_rad))),
      east_m_per_rad_(wgs84::transverse_radius_from_sine_m(std::sin(origin.latitude_rad)) *
                      std::cos(origin.latitude_rad)),
      waves_(std::move(waves)) {
  const bool usable = std::all_of(waves_.begin(), waves_.end(), [](const Wave& wave) {
    return std::hypot(wave.north_rad_per_m, wave.east_rad_per_m) > 0.0;
  });
  if (!usable || !(cell_m > 0.0))
    throw std::invalid_argument("a wave of gravity, or a cell of its field, has no length");
}

/// North, east and up of the origin's place on the ellipsoid.
Vector3 GravityField::local_m(const Geodetic& position) const {
  return {(position.latitude_rad - origin_.latitude_rad) * north_m_per_rad_,
          wrapped_to_pi(position.longitude_rad - origin_.longitude_rad) * east_m_per_rad_,
          std::max(position.height_m, 0.0)};
}

Vector3 GravityField::exact_n(const Geodetic& position) const {
  const Vector3 x_m = local_m(position);
  Vector3 sum = Vector3::Zero();
  for (const Wave& wave : waves_) sum += WaveThere(wave, x_m).gradient_n(1.0);
  return sum;
}

Vector3 GravityField::disturbance_n(const Geodetic& position, Cell& cell) const {
  const Vector3 x_m = local_m(position);
  std::array<std::int64_t, 3> index{};
  Vector3 middle_m;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    index[i] = static_cast<std::int64_t>(std::floor(x_m[axis] / cell_m_));
    middle_m[axis] = (static_cast<double>(index[i]) + 0.5) * cell_m_;
  }
  if (index != cell.index) {
    cell.index = index;
    cell.of_power.fill(Vector3::Zero());
    for (const Wave& wave : waves_) {
      const WaveThere there(wave, middle_m);
      const auto north = taylor_powers(there.by_north * there.k_rad_per_m);
      const auto east = taylor_powers(there.by_east * there.k_rad_per_m);
      const auto up = taylor_powers(-there.by_down * there.k_rad_per_m);
      for_each_power([&](std::size_t power, int n, int e, int u) {
        cell.of_power[power] += there.gradient_n(north[n] * east[e] * up[u]);
      });
    }
  }
  const Vector3 off_m = x_m - middle_m;
  std::array<Vector3, kHighest + 1> powers;
  powers[0] = Vector3::Ones();
  for (std::size_t n = 1; n <= kHighest; ++n) powers[n] = powers[n - 1].cwiseProduct(off_m);
  Vector3 sum = Vector3::Zero();
  for_each_power([&](std::size_t power, int n, int e, int u) {
    sum += powers[n].x() * powers[e].y() * powers[u].z() * cell.of_power[power];
  });
  return sum;
}

}  // namespace inslab::nav
