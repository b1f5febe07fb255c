#pragma once

#include <vector>

#include "inslab/nav/position_spline.hpp"

namespace inslab::nav {

/// A smooth line over the Earth through points that may lie far apart, measured by its length.
struct SurfaceCurve {
  PositionSpline line;                      ///< parameter: length along the line, m, to about 1e-4 of it
  std::vector<std::size_t> index_of_point;  ///< where in `line` each of the points is
};

/// The line through `points`, twice continuously differentiable. Its direction from the Earth (the ellipsoid's normal)
/// is a cubic spline over the distance, so between two points it is a great ellipse's arc but for the bends that meet
/// the neighbours; heights rise and fall with the points' and exceed them by at most 4e-6 of a step.
///
/// At least two points; neighbours 1 m to 1000 km apart; a line that turns back on itself at a point has a slope there
/// far from 1 in length, or NaN. Heights: F. Fritsch, J. Butland, A method for constructing local monotone piecewise
/// cubic interpolants (1984), for the slopes.
SurfaceCurve surface_curve(const std::vector<Geodetic>& points);

}  // namespace inslab::nav
