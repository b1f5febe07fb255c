#pragma once

#include <vector>

#include "inslab/nav/surface_curve.hpp"
#include "inslab/scenario/path_piece.hpp"
#include "inslab/scenario/waypoint.hpp"

namespace inslab::scenario {

/// Place over time along waypoints, twice continuously differentiable.
///
/// The line is nav::surface_curve(). On a leg of length U, between the speeds v0 and v1, the time is T = 2 U/(v0 + v1),
/// to the nanosecond, and the speed v0 + (v1 - v0)(3 x^2 - 2 x^3) with x = t/T; so the acceleration along the line is 0
/// at every waypoint. A waypoint's place and speed are met exactly.
///
/// A leg with a speed of its own, w, begins and ends with ramps v + (w - v)(10 x^3 - 15 x^4 + 6 x^5), whose
/// acceleration and jerk are 0 at both ends and whose largest acceleration is the options'; between them the speed is
/// w. Where both ramps do not fit, w is less. With stops_part each stretch between two stops is a line of its own.
class WaypointRoute {
 public:
  /// The waypoints keep the rules of violation().
  explicit WaypointRoute(const std::vector<Waypoint>& waypoints, const RouteOptions& options = {});

  /// The vehicle stays at the last waypoint, where its speed is 0, at least until `end`.
  void stay_until(time::Nanoseconds end);

  std::size_t pieces() const { return pieces_.size(); }
  PathPiece piece(std::size_t index) const;
  time::Nanoseconds duration() const { return pieces_.empty() ? time::Nanoseconds(0) : pieces_.back().end; }
  /// When the vehicle comes to a waypoint, and when it leaves it; 0 and the first wait's end for the first.
  time::Nanoseconds arrival(std::size_t waypoint) const { return arrivals_[waypoint]; }
  time::Nanoseconds departure(std::size_t waypoint) const { return departures_[waypoint]; }

  /// A line and the waypoint at its start.
  struct Run {
    nav::SurfaceCurve curve;
    std::size_t first = 0;
  };
  /// The lines through the waypoints, before there are any times.
  static std::vector<Run> runs_of(const std::vector<Waypoint>& waypoints, const RouteOptions& options);

 private:
  /// A leg, or a part of one, over which the speed is one polynomial.
  struct Phase {
    TimeLaw law;  ///< length from the leg's start over the time since the phase's
    time::Nanoseconds start{0};
    time::Nanoseconds end{0};
  };
  /// A part of a phase on one cubic of a line, or a wait on the cubic that follows.
  struct Stretch {
    time::Nanoseconds end{0};
    std::size_t leg = 0;
    std::size_t run = 0;
    std::size_t cubic = 0;
    std::size_t phase = 0;
    double length_m = 0.0;  ///< of the leg before `cubic`
    bool waits = false;
  };
  /// The cubics of a leg.
  struct Cubics {
    std::size_t run = 0;
    std::size_t first = 0;
    std::size_t last = 0;  ///< one after
    double length_m = 0.0;
  };

  void add_wait(std::size_t waypoint, time::Nanoseconds duration);
  void add_leg(std::size_t leg, const Waypoint& from, const Waypoint& to, const RouteOptions& options);
  void add_phase(std::size_t leg, const Cubics& cubics, const TimeLaw& law, time::Nanoseconds span, bool is_last);
  std::size_t run_of_leg(std::size_t leg) const;

  std::vector<Run> runs_;
  std::vector<Phase> phases_;
  std::vector<Stretch> pieces_;
  std::vector<time::Nanoseconds> arrivals_;
  std::vector<time::Nanoseconds> departures_;
};

}  // namespace inslab::scenario
