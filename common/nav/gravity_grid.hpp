#pragma once

#include <cstddef>
#include <vector>

#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/gravity_along_way.hpp"

namespace inslab::nav {

/// The part of gravity that varies with place, by its values at the knots of a regular grid of latitude and longitude.
/// Between them it goes by cubic convolution along both: a function with a continuous slope, through every knot, exact
/// for polynomials to the second degree (R. Keys, Cubic convolution interpolation for digital image processing, IEEE
/// Trans. Acoust. Speech Signal Process. 29(6), 1981, with a = -1/2 and his rows beyond the borders). It is the same at
/// every height, and beyond the grid that of its border.
class GravityGrid {
 public:
  /// Knots first_rad + i step_rad, i = 0 .. knots - 1.
  struct Axis {
    double first_rad = 0.0;
    double step_rad = 0.0;  ///< above 0
    std::size_t knots = 0;  ///< 3 at least

    double last_rad() const { return first_rad + static_cast<double>(knots - 1) * step_rad; }
  };

  /// `disturbance_n`, m/s^2, one a knot: all longitudes of the first latitude, then those of the next one. Throws
  /// std::invalid_argument when they are not as many as the axes say, or an axis is no axis.
  GravityGrid(const Axis& latitude, const Axis& longitude, const std::vector<Vector3>& disturbance_n);

  bool contains(const Geodetic& position) const;

  /// North, east, down, m/s^2.
  Vector3 disturbance_n(const Geodetic& position) const;

  /// Root mean squares of the knots, and the distance at which a process has the mean square of their slopes from knot
  /// to knot, north and east alike; 0 when all are equal.
  GravityAlongWay along_way() const;

 private:
  /// Where a coordinate lies on an axis, in steps from its first knot; a longitude by the turn that is nearest.
  double steps_of_latitude(double latitude_rad) const;
  double steps_of_longitude(double longitude_rad) const;

  Axis latitude_;
  Axis longitude_;
  std::size_t row_;                   ///< values a latitude, one beyond each border
  std::vector<Vector3> with_border_;  ///< m/s^2
};

}  // namespace inslab::nav
