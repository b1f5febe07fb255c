#include "inslab/nav/surface_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::nav {
namespace surface_curve_test {

Geodetic degrees(double latitude, double longitude, double height_m) {
  return {latitude * units::kDeg, longitude * units::kDeg, height_m};
}

/// Places along the line, eight to a cubic.
std::vector<Geodetic> places_along(const SurfaceCurve& curve) {
  std::vector<Geodetic> places;
  for (std::size_t k = 0; k < curve.line.pieces(); ++k) {
    const PositionPiece piece = curve.line.piece(k);
    for (int j = 0; j < 8; ++j) {
      places.push_back(displaced(piece.origin, piece.displacement_k(curve.line.interval(k) * j / 8.0)));
    }
  }
  return places;
}

TEST(SurfaceCurve, HoldsThePointsThemselves) {
  const std::vector<Geodetic> points{degrees(-41.0, 179.5, 10.0), degrees(-41.5, -179.7, 500.0),
                                     degrees(-40.8, -178.9, 200.0)};
  const SurfaceCurve curve = surface_curve(points);
  ASSERT_EQ(curve.index_of_point.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Geodetic& point = curve.line.point(curve.index_of_point[k]);
    EXPECT_EQ(point.latitude_rad, points[k].latitude_rad);
    EXPECT_EQ(point.longitude_rad, points[k].longitude_rad);
    EXPECT_EQ(point.height_m, points[k].height_m);
  }
}

TEST(SurfaceCurve, StaysAboveTheGroundOverAThousandKilometres) {
  // The chord of such a leg lies 20 km deep. A cubic of 5 km leaves the arc by h^4/R^3/384 = 6e-9 m.
  const SurfaceCurve curve = surface_curve({degrees(50.0, 5.0, 1000.0), degrees(50.0, 18.9, 1000.0)});
  for (const Geodetic& place : places_along(curve)) EXPECT_NEAR(place.height_m, 1000.0, 2e-8);
}

TEST(SurfaceCurve, IsMeasuredByItsLength) {
  const SurfaceCurve curve =
      surface_curve({degrees(10.0, 5.0, 0.0), degrees(10.01, 5.0, 0.0), degrees(10.01, 5.01, 100.0)});
  for (std::size_t k = 0; k <= curve.line.pieces(); ++k) {
    EXPECT_NEAR(curve.line.slope_e(k).norm(), 1.0, 1e-4) << k;
  }
  // North by 0.01 deg on the meridian of the ellipsoid, a = 6378137 m: 1105.8 m, and more for the bend that follows.
  const double first_leg_m = [&] {
    double sum_m = 0.0;
    for (std::size_t k = 0; k < curve.index_of_point[1]; ++k) sum_m += curve.line.interval(k);
    return sum_m;
  }();
  EXPECT_GT(first_leg_m, 1105.8);
  EXPECT_LT(first_leg_m, 1.1 * 1105.8);
}

TEST(SurfaceCurve, NeverRisesBeyondItsPoints) {
  // Steps that an ordinary cubic spline would overshoot by a tenth.
  std::vector<Geodetic> points;
  const double heights_m[] = {0.0, 0.0, 500.0, 500.0, 480.0, 100.0, 100.0};
  for (int k = 0; k < 7; ++k) points.push_back(degrees(0.0, 0.02 * k + 0.015 * (k > 3), heights_m[k]));
  double lowest = 1e9, highest = -1e9;
  for (const Geodetic& place : places_along(surface_curve(points))) {
    lowest = std::min(lowest, place.height_m);
    highest = std::max(highest, place.height_m);
  }
  // Where a step begins the third derivative jumps by 60 times the step over the leg cubed; a cubic spline over parts
  // of 1/24 of the leg answers with less than 1/1000 of jump times part cubed: 60/24^3/1000 = 4e-6 of the step.
  EXPECT_GT(lowest, -2e-3);
  EXPECT_LT(highest, 500.0 + 2e-3);
}

TEST(SurfaceCurve, ShowsATurnBackByAVanishingSlope) {
  const SurfaceCurve curve = surface_curve({degrees(1.0, 1.0, 0.0), degrees(1.0, 1.1, 0.0), degrees(1.0, 1.0, 0.0)});
  EXPECT_FALSE(curve.line.slope_e(curve.index_of_point[1]).norm() > 0.3);
}

}  // namespace surface_curve_test
}  // namespace inslab::nav
