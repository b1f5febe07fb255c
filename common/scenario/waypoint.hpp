#pragma once

#include <optional>
#include <vector>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::scenario {

/// A place to pass through at a speed (math in docs/models.md).
struct Waypoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  double speed_m_per_s = 0.0;
  double wait_s = 0.0;
  std::optional<double> leg_speed_m_per_s = std::nullopt;
  std::optional<double> yaw_deg = std::nullopt;

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
    visit(Field("leg_speed_m_per_s",
                "on the leg that leads here, which speeds up to it and brakes again at trajectory.leg_acceleration_"
                "m_per_s2; on a short leg less; absent: straight from one speed to the other")
              .in(1e-3, 1e4),
          self.leg_speed_m_per_s);
    visit(Field("yaw_deg",
                "of a multirotor's nose when it leaves: turned to while it waits here, or without a wait on the way "
                "here; absent: as it was")
              .in(-180.0, 360.0),
          self.yaw_deg);
  }
};

/// How a route is made of waypoints.
struct RouteOptions {
  double leg_acceleration_m_per_s2 = 2.0;  ///< the largest along the path, on legs with a speed of their own
  bool stops_part = false;                 ///< straight on to a stop and in any direction away, not one curve through
};

/// The first rule that waypoints break, or nothing: at least two; neighbours 1 m to 500 km apart; a speed on every leg,
/// its own or that of an end; waits only at rest; no turning back; accelerations within the limit; 1e9 s in all.
std::optional<Violation> violation(const std::vector<Waypoint>& waypoints, double max_acceleration_m_per_s2,
                                   const RouteOptions& options = {});

}  // namespace inslab::scenario
