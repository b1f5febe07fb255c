#pragma once

#include <vector>

#include "nav/surface_curve.hpp"
#include "scenario/path_piece.hpp"
#include "scenario/waypoint.hpp"

namespace inslab::scenario {

/// Place over time along waypoints, twice continuously differentiable.
///
/// The line is nav::surface_curve(). On a leg of length U, between the speeds v0 and v1, the time is T = 2 U/(v0 + v1),
/// to the nanosecond, and the speed v0 + (v1 - v0)(3 x^2 - 2 x^3) with x = t/T; so the acceleration along the line is 0
/// at every waypoint. A waypoint's place and speed are met exactly.
class WaypointRoute {
 public:
  /// The waypoints keep the rules of violation().
  explicit WaypointRoute(const std::vector<Waypoint>& waypoints);

  /// The vehicle stays at the last waypoint, where its speed is 0, at least until `end`.
  void stay_until(time::Nanoseconds end);

  std::size_t pieces() const { return pieces_.size(); }
  PathPiece piece(std::size_t index) const;
  time::Nanoseconds duration() const { return pieces_.back().end; }
  const nav::SurfaceCurve& curve() const { return curve_; }

 private:
  struct Leg {
    TimeLaw law;  ///< length from the leg's start over the time since
    time::Nanoseconds start{0};
    time::Nanoseconds end{0};
  };
  /// A part of a leg on one cubic of the line, or a wait on the cubic that follows.
  struct Stretch {
    time::Nanoseconds end{0};
    std::size_t leg = 0;
    std::size_t cubic = 0;
    double length_m = 0.0;  ///< of the leg before `cubic`
    bool waits = false;
  };

  void add_wait(std::size_t waypoint, time::Nanoseconds duration);
  void add_leg(std::size_t leg, double v0_m_per_s, double v1_m_per_s);

  nav::SurfaceCurve curve_;
  std::vector<Leg> legs_;
  std::vector<Stretch> pieces_;
};

}  // namespace inslab::scenario
