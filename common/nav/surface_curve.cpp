#include "inslab/nav/surface_curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "inslab/nav/cubic_spline.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

// Every leg becomes at least this many cubics over length, each at most so long: the cubic then leaves the arc by
// h^4/384 over the radius cubed, 6e-9 m, and its slope is 1 to 1e-4 where a leg turns by a right angle.
constexpr int kFewestCubics = 24;
constexpr double kLongestCubic_m = 5000.0;

/// Gauss's rule of three nodes on [0, 1].
constexpr double kFirstNode = 0.11270166537925831;
constexpr double kNodes[3] = {kFirstNode, 0.5, 1.0 - kFirstNode};
constexpr double kWeights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// From one point to the next, over x from 0 to 1.
struct Leg {
  Vector3 normal_e, c1, c2, c3;  ///< the direction (not of unit length) and its powers of x
  double height_m = 0.0;
  double rise_m = 0.0;         ///< to the next point
  double slope_first_m = 0.0;  ///< of the height, by x
  double slope_last_m = 0.0;
};

struct Place {
  Geodetic position;
  Vector3 slope_n = Vector3::Zero();  ///< m by x
};

/// The height and its derivative by x: h' = s0 (1 - S) + s1 S + (rise - (s0 + s1)/2) 30 x^2 (1 - x)^2 with
/// S = 3 x^2 - 2 x^3, so h'' = 0 at both ends; h' keeps its sign while both slopes are at most twice the rise.
std::pair<double, double> height_of(const Leg& leg, double x) {
  const double s0 = leg.slope_first_m, ds = leg.slope_last_m - leg.slope_first_m;
  const double bump = leg.rise_m - 0.5 * (leg.slope_first_m + leg.slope_last_m);
  const double x2 = x * x, x3 = x2 * x;
  return {leg.height_m + s0 * x + ds * x3 * (1.0 - 0.5 * x) + bump * x3 * (10.0 + x * (-15.0 + 6.0 * x)),
          s0 + ds * x2 * (3.0 - 2.0 * x) + bump * 30.0 * x2 * (1.0 - x) * (1.0 - x)};
}

Place place_on(const Leg& leg, double x) {
  const Vector3 direction = leg.normal_e + x * (leg.c1 + x * (leg.c2 + x * leg.c3));
  const Vector3 change = leg.c1 + x * (2.0 * leg.c2 + 3.0 * x * leg.c3);
  const double length = direction.norm();
  const double from_axis = std::hypot(direction.x(), direction.y());
  const auto [height_m, climb_m] = height_of(leg, x);
  const Geodetic position{std::atan2(direction.z(), from_axis), std::atan2(direction.y(), direction.x()), height_m};
  const Vector3 turned_n = C_en(position.latitude_rad, position.longitude_rad).transpose() * change / length;
  return {position, Vector3((wgs84::meridian_radius_m(position.latitude_rad) + height_m) * turned_n.x(),
                            (wgs84::transverse_radius_m(position.latitude_rad) + height_m) * turned_n.y(), -climb_m)};
}

/// The line's direction, of length 1, in e.
Vector3 direction_e(const Place& place) {
  return C_en(place.position.latitude_rad, place.position.longitude_rad) * place.slope_n.normalized();
}

/// The height's slope at the point between two legs: 0 at a summit or a valley, or else a weighted harmonic mean of the
/// legs' own, at most twice the smaller.
double slope_between(double h0, double slope0, double h1, double slope1) {
  if (slope0 * slope1 <= 0.0) return 0.0;
  const double mean = 3.0 * (h0 + h1) / ((2.0 * h1 + h0) / slope0 + (h1 + 2.0 * h0) / slope1);
  const double limit = 2.0 * std::min(std::abs(slope0), std::abs(slope1));
  return std::clamp(mean, -limit, limit);
}

std::vector<Leg> legs_of(const std::vector<Geodetic>& points) {
  const std::size_t n = points.size() - 1;
  std::vector<double> distance_m(n), climb(n);
  std::vector<Vector3> normals_e(n + 1), chords(n);
  for (std::size_t k = 0; k <= n; ++k) {
    normals_e[k] = -C_en(points[k].latitude_rad, points[k].longitude_rad).col(2);
  }
  for (std::size_t k = 0; k < n; ++k) {
    distance_m[k] = ned_from(points[k], points[k + 1]).norm();
    chords[k] = (normals_e[k + 1] - normals_e[k]) / distance_m[k];
    climb[k] = (points[k + 1].height_m - points[k].height_m) / distance_m[k];
  }
  const std::vector<Vector3> slopes = cubic_spline_slopes(distance_m, chords, std::nullopt, std::nullopt);
  std::vector<Leg> legs(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double h = distance_m[k];
    const Vector3 m0 = h * slopes[k], m1 = h * slopes[k + 1], D = h * chords[k];
    const auto slope = [&](std::size_t point) {
      if (point == 0) return climb.front();
      return point == n ? climb.back()
                        : slope_between(distance_m[point - 1], climb[point - 1], distance_m[point], climb[point]);
    };
    legs[k] = {normals_e[k], m0,           3.0 * D - 2.0 * m0 - m1, m0 + m1 - 2.0 * D, points[k].height_m,
               h * climb[k], h * slope(k), h * slope(k + 1)};
  }
  return legs;
}

}  // namespace

SurfaceCurve surface_curve(const std::vector<Geodetic>& points) {
  std::vector<Geodetic> places;
  std::vector<double> lengths_m;
  std::vector<std::size_t> index_of_point;
  const std::vector<Leg> legs = legs_of(points);
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const double distance_m = ned_from(points[k], points[k + 1]).norm();
    const int cubics = std::max(kFewestCubics, static_cast<int>(std::ceil(distance_m / kLongestCubic_m)));
    index_of_point.push_back(places.size());
    for (int j = 0; j < cubics; ++j) {
      places.push_back(j == 0 ? points[k] : place_on(legs[k], static_cast<double>(j) / cubics).position);
      double length_m = 0.0;
      for (int i = 0; i < 3; ++i)
        length_m += kWeights[i] / cubics * place_on(legs[k], (j + kNodes[i]) / cubics).slope_n.norm();
      lengths_m.push_back(length_m);
    }
  }
  index_of_point.push_back(places.size());
  places.push_back(points.back());
  const PositionSpline::Ends ends{direction_e(place_on(legs.front(), 0.0)), direction_e(place_on(legs.back(), 1.0))};
  return {PositionSpline(std::move(places), std::move(lengths_m), ends), std::move(index_of_point)};
}

}  // namespace inslab::nav
