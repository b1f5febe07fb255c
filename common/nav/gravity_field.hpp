#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "inslab/nav/geodesy.hpp"

namespace inslab::nav {

/// The part of gravity that varies with place: the gradient of a harmonic disturbing potential that is a sum of plane
/// waves about an origin,
///
///   T = g0 sum_m a_m cos(k_m . x + phase_m) exp(-|k_m| z),
///
/// x metres of arc to the north and the east of the origin, z the height above the ellipsoid (below it: 0), g0 standard
/// gravity. A function of place alone, whatever the way there.
class GravityField {
 public:
  /// One wave. Its deflection of the vertical, along k at z = 0, has the amplitude a |k|.
  struct Wave {
    double north_rad_per_m = 0.0;  ///< k
    double east_rad_per_m = 0.0;
    double deflection_rad = 0.0;  ///< a |k|
    double phase_rad = 0.0;
  };

  /// `cell_m`: the edge of the cubes in which disturbance_n goes by powers; a few hundredths of the shortest 1/|k| that
  /// matters. Waves of no length throw std::invalid_argument.
  GravityField(const Geodetic& origin, double cell_m, std::vector<Wave> waves);

  /// grad T in n, m/s^2, term by term.
  Vector3 exact_n(const Geodetic& position) const;

  /// The powers of the place, to the third, about the middle of one cube.
  struct Cell {
    static constexpr int kPowers = 20;
    std::array<std::int64_t, 3> index{INT64_MIN, 0, 0};
    std::array<Vector3, kPowers> of_power{};
  };

  /// The same by the powers of the cube around the place, which leaves at most (|k| cell)^4/42 of a wave: 1e-8 of it
  /// where the cell is 1/40 of 1/|k|. `cell` holds the last cube; it changes no value.
  Vector3 disturbance_n(const Geodetic& position, Cell& cell) const;

 private:
  Vector3 local_m(const Geodetic& position) const;

  Geodetic origin_;
  double cell_m_;
  double north_m_per_rad_;
  double east_m_per_rad_;
  std::vector<Wave> waves_;
};

}  // namespace inslab::nav
