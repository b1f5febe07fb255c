#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab {
inline namespace samples {

/// Stretches of sim time without GNSS signals: start_s + n period_s <= t < start_s + n period_s + duration_s, with
/// n = 0 alone when period_s is 0, and n = 0, 1, 2, ... until the end of the run otherwise.
struct Outage {
  double start_s = 0.0;
  double duration_s = 0.0;
  double period_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("start_s", "sim time").in(0.0, 1e7).required(), self.start_s);
    visit(Field("duration_s").in(0.0, 1e7).required(), self.duration_s);
    visit(Field("period_s", "from one beginning to the next, longer than the outage; 0: once").in(0.0, 1e7),
          self.period_s);
  }
};

/// A place by latitude and longitude.
struct GroundPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("latitude_deg").in(-89.9, 89.9).required(), self.latitude_deg);
    visit(Field("longitude_deg").in(-180.0, 180.0).required(), self.longitude_deg);
  }
};

/// On the ellipsoid, in ECEF, m.
inline Vector3 ground_point_e(const GroundPoint& point) {
  return nav::ecef_from_geodetic({point.latitude_deg * units::kDeg, point.longitude_deg * units::kDeg, 0.0});
}

/// A chord of this length runs 2 m under the ellipsoid in its middle.
inline constexpr double kMaxOutageLegM = 1e4;

/// A place without GNSS signals: what lies within `radius_m` of a path, at any height. A tunnel is a path of several
/// points, a hall is one point.
struct OutageArea {
  std::string name;
  double radius_m = 0.0;
  std::vector<GroundPoint> path;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("name", "a word for the reader").at_most(64), self.name);
    visit(Field("radius_m", "half the width").in(0.1, 1e5).required(), self.radius_m);
    visit(Field("path", "a point, or the points that straight legs of at most 10 km join").at_most(1000).required(),
          self.path);
  }
};

}  // namespace samples
}  // namespace inslab
