#pragma once

#include <optional>
#include <vector>

#include "nav/geodesy.hpp"
#include "samples/field.hpp"
#include "samples/violation.hpp"

namespace inslab::scenario {

/// A place to pass through at a speed (math in docs/models.md).
struct Waypoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  double speed_m_per_s = 0.0;
  double wait_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("latitude_deg", "WGS-84").in(-nav::kMaxLatitudeDeg, nav::kMaxLatitudeDeg).required(),
          self.latitude_deg);
    visit(Field("longitude_deg", "WGS-84, east positive").in(-180.0, 360.0).required(), self.longitude_deg);
    visit(Field("height_m", "above the ellipsoid").in(nav::kMinHeightM, nav::kMaxHeightM).required(), self.height_m);
    visit(Field("speed_m_per_s",
                "along the path, exactly here; between two waypoints it goes smoothly from one to the "
                "other")
              .in(0.0, 1e4)
              .required(),
          self.speed_m_per_s);
    visit(Field("wait_s", "at rest here, where the speed is 0; rounded to the nanosecond").in(0.0, 1e7), self.wait_s);
  }
};

/// The first rule that waypoints break, or nothing: at least two; neighbours 1 m to 500 km apart; a speed at one end of
/// every leg at least; waits only at rest; no turning back; accelerations within the limit; 1e9 s in all.
std::optional<Violation> violation(const std::vector<Waypoint>& waypoints, double max_acceleration_m_per_s2);

}  // namespace inslab::scenario
