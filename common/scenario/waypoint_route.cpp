#include "inslab/scenario/waypoint_route.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "inslab/foundation/units/units.hpp"

namespace inslab::scenario {

namespace {

constexpr double kClosest_m = 1.0;
constexpr double kFarthest_m = 500e3;
constexpr double kLongest_s = 1e9;
// Where the line turns back on itself, its slope by its own length vanishes.
constexpr double kLeastSlope = 0.5;
// The largest acceleration of a ramp over its mean.
constexpr double kRampPeak = 1.875;
constexpr double kShortestCruise_s = 0.01;

nav::Geodetic position(const Waypoint& waypoint) {
  return {waypoint.latitude_deg * units::kDeg, nav::wrapped_to_pi(waypoint.longitude_deg * units::kDeg),
          waypoint.height_m};
}

std::vector<nav::Geodetic> positions(const std::vector<Waypoint>& waypoints) {
  std::vector<nav::Geodetic> points;
  points.reserve(waypoints.size());
  for (const Waypoint& waypoint : waypoints) points.push_back(position(waypoint));
  return points;
}

std::string at(std::size_t waypoint, const char* key) {
  return "waypoints[" + std::to_string(waypoint) + "]" + (*key == '\0' ? "" : ".") + key;
}

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return text.str();
}

std::optional<Violation> single_violation(const std::vector<Waypoint>& waypoints) {
  if (waypoints.size() < 2) {
    return Violation{Rule::WaypointCount, "waypoints",
                     "has " + std::to_string(waypoints.size()) + "; a path needs at least two"};
  }
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    if (waypoints[k].wait_s > 0.0 && waypoints[k].speed_m_per_s > 0.0) {
      return Violation{Rule::WaypointWait, at(k, "wait_s"), "is set where the speed is not 0"};
    }
  }
  return std::nullopt;
}

/// How a leg with a speed of its own is divided.
struct LegPlan {
  double top_m_per_s = 0.0;
  double ramp_up_s = 0.0;
  double cruise_s = 0.0;
  double ramp_down_s = 0.0;

  double total_s() const { return ramp_up_s + cruise_s + ramp_down_s; }
};

LegPlan plan(double length_m, double v0_m_per_s, double v1_m_per_s, double speed_m_per_s,
             double acceleration_m_per_s2) {
  const double a = acceleration_m_per_s2 / kRampPeak;
  const double ends = v0_m_per_s * v0_m_per_s + v1_m_per_s * v1_m_per_s;
  const double ramps_m = (2.0 * speed_m_per_s * speed_m_per_s - ends) / (2.0 * a);
  LegPlan plan;
  plan.top_m_per_s = ramps_m <= length_m ? speed_m_per_s : std::sqrt(a * length_m + 0.5 * ends);
  plan.ramp_up_s = std::max(0.0, plan.top_m_per_s - v0_m_per_s) / a;
  plan.ramp_down_s = std::max(0.0, plan.top_m_per_s - v1_m_per_s) / a;
  plan.cruise_s = std::max(0.0, (length_m - ramps_m) / speed_m_per_s);
  return plan;
}

std::optional<Violation> leg_speed_violation(const Waypoint& from, const Waypoint& to, std::size_t index,
                                             const LegPlan& plan) {
  const double faster_m_per_s = std::max(from.speed_m_per_s, to.speed_m_per_s);
  if (*to.leg_speed_m_per_s < faster_m_per_s) {
    return Violation{Rule::WaypointLegSpeed, at(index, "leg_speed_m_per_s"),
                     text_of("is ", *to.leg_speed_m_per_s, ", below the ", faster_m_per_s,
                             " m/s at an end of its leg; expected that or more")};
  }
  // Where a ramp fills the leg, its length to 1e-4 decides.
  if (plan.cruise_s > 0.0 || plan.top_m_per_s >= 1.001 * faster_m_per_s) return std::nullopt;
  return Violation{
      Rule::WaypointLegSpeed, at(index, "leg_speed_m_per_s"),
      text_of("is set on a leg that is too short to go from ", from.speed_m_per_s, " to ", to.speed_m_per_s,
              " m/s at leg_acceleration_m_per_s2; expected a longer leg, nearer speeds "
              "or a larger acceleration")};
}

std::optional<Violation> leg_violation(const std::vector<Waypoint>& waypoints, const RouteOptions& options) {
  double total_s = waypoints.front().wait_s;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    const double distance_m = nav::ned_from(position(waypoints[k - 1]), position(waypoints[k])).norm();
    if (!(distance_m >= kClosest_m && distance_m <= kFarthest_m)) {
      return Violation{Rule::WaypointsApart, at(k, ""),
                       text_of("lies ", distance_m, " m from the one before; expected ", kClosest_m, " m to ",
                               kFarthest_m / 1e3, " km")};
    }
    const Waypoint &from = waypoints[k - 1], &to = waypoints[k];
    if (to.leg_speed_m_per_s) {
      const LegPlan leg = plan(distance_m, from.speed_m_per_s, to.speed_m_per_s, *to.leg_speed_m_per_s,
                               options.leg_acceleration_m_per_s2);
      if (auto broken = leg_speed_violation(from, to, k, leg)) return broken;
      total_s += leg.total_s() + to.wait_s;
    } else {
      const double both_m_per_s = from.speed_m_per_s + to.speed_m_per_s;
      if (both_m_per_s == 0.0) {
        return Violation{Rule::WaypointSpeeds, at(k, "speed_m_per_s"),
                         "is 0, as at the waypoint before: the leg between them would never end; expected a speed at "
                         "one of them, or leg_speed_m_per_s here"};
      }
      total_s += 2.0 * distance_m / both_m_per_s + to.wait_s;
    }
    if (!(total_s <= kLongest_s)) {
      return Violation{Rule::TrajectoryLength, at(k, "speed_m_per_s"), "brings the total above 1e9 s"};
    }
  }
  return std::nullopt;
}

std::optional<Violation> turn_violation(const WaypointRoute::Run& run) {
  const nav::SurfaceCurve& curve = run.curve;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k <= curve.line.pieces(); ++k) {
    const std::size_t next = std::min(nearest + 1, curve.index_of_point.size() - 1);
    if (2 * k > curve.index_of_point[nearest] + curve.index_of_point[next]) nearest = next;
    if (!(curve.line.slope_e(k).norm() >= kLeastSlope)) {
      return Violation{Rule::WaypointTurn, at(run.first + nearest, ""),
                       "makes the path turn back on itself; expected a bend that a smooth path can follow"};
    }
  }
  return std::nullopt;
}

std::optional<Violation> acceleration_violation(const WaypointRoute& route, double max_m_per_s2) {
  for (std::size_t i = 0; i < route.pieces(); ++i) {
    const PathPiece piece = route.piece(i);
    const double span_s = time::to_seconds(piece.end - piece.start);
    for (const double part : {0.0, 0.5, 1.0}) {
      const double acceleration = piece.acceleration_k(part * span_s).norm();
      if (acceleration <= max_m_per_s2) continue;
      return Violation{Rule::WaypointAcceleration, at(piece.index, ""),
                       text_of("leads into an acceleration of ", acceleration, " m/s^2 at ",
                               time::to_seconds(piece.start) + part * span_s, " s; expected at most ", max_m_per_s2)};
    }
  }
  return std::nullopt;
}

/// The law with time counted from `t_s` and length from its value there less `length_m`.
TimeLaw shifted(const TimeLaw& law, double t_s, double length_m) {
  TimeLaw result = law;
  // Horner's scheme, once for every power.
  for (std::size_t i = 0; i + 1 < law.c.size(); ++i) {
    for (std::size_t j = law.c.size() - 1; j-- > i;) result.c[j] += t_s * result.c[j + 1];
  }
  result.c[0] -= length_m;
  return result;
}

/// When the law, which rises from 0 over `span_s`, reaches a length: bisection, to the last bit.
double time_of(const TimeLaw& law, double length_m, double span_s) {
  double before = 0.0, after = span_s;
  while (true) {
    const double middle = 0.5 * (before + after);
    if (middle <= before || middle >= after) return middle;
    (law.value(middle) < length_m ? before : after) = middle;
  }
}

}  // namespace

std::optional<Violation> violation(const std::vector<Waypoint>& waypoints, double max_acceleration_m_per_s2,
                                   const RouteOptions& options) {
  if (auto broken = single_violation(waypoints)) return broken;
  if (auto broken = leg_violation(waypoints, options)) return broken;
  // Where a line turns back it has no slope, and the times along it are infinite.
  for (const WaypointRoute::Run& run : WaypointRoute::runs_of(waypoints, options)) {
    if (auto broken = turn_violation(run)) return broken;
  }
  return acceleration_violation(WaypointRoute(waypoints, options), max_acceleration_m_per_s2);
}

std::vector<WaypointRoute::Run> WaypointRoute::runs_of(const std::vector<Waypoint>& waypoints,
                                                       const RouteOptions& options) {
  std::vector<Run> runs;
  std::vector<Waypoint> run{waypoints.front()};
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    run.push_back(waypoints[k]);
    const bool parts = options.stops_part && waypoints[k].speed_m_per_s == 0.0;
    if (!parts && k + 1 < waypoints.size()) continue;
    runs.push_back({nav::surface_curve(positions(run)), k + 1 - run.size()});
    run = {waypoints[k]};
  }
  return runs;
}

WaypointRoute::WaypointRoute(const std::vector<Waypoint>& waypoints, const RouteOptions& options)
    : runs_(runs_of(waypoints, options)) {
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    if (k > 0) add_leg(k - 1, waypoints[k - 1], waypoints[k], options);
    arrivals_.push_back(duration());
    add_wait(k, time::from_seconds(waypoints[k].wait_s));
    departures_.push_back(duration());
  }
}

void WaypointRoute::stay_until(time::Nanoseconds end) {
  if (end <= duration()) return;
  add_wait(arrivals_.size() - 1, end - duration());
  departures_.back() = end;
}

std::size_t WaypointRoute::run_of_leg(std::size_t leg) const {
  std::size_t run = runs_.size() - 1;
  while (runs_[run].first > leg) --run;
  return run;
}

void WaypointRoute::add_wait(std::size_t waypoint, time::Nanoseconds duration) {
  if (duration.count() <= 0) return;
  const std::size_t run = run_of_leg(waypoint);
  const std::size_t cubic = runs_[run].curve.index_of_point[waypoint - runs_[run].first];
  pieces_.push_back({this->duration() + duration, waypoint, run, cubic, 0, 0.0, true});
}

void WaypointRoute::add_leg(std::size_t leg, const Waypoint& from, const Waypoint& to, const RouteOptions& options) {
  Cubics cubics;
  cubics.run = run_of_leg(leg);
  const Run& run = runs_[cubics.run];
  const nav::PositionSpline& line = run.curve.line;
  cubics.first = run.curve.index_of_point[leg - run.first];
  cubics.last = run.curve.index_of_point[leg - run.first + 1];
  for (std::size_t k = cubics.first; k < cubics.last; ++k) cubics.length_m += line.interval(k);
  // By the parameter: the line's slope is nearly, not exactly, of length 1.
  const double w0 = from.speed_m_per_s / line.slope_e(cubics.first).norm();
  const double w1 = to.speed_m_per_s / line.slope_e(cubics.last).norm();
  if (!to.leg_speed_m_per_s) {
    const time::Nanoseconds span = time::from_seconds(2.0 * cubics.length_m / (w0 + w1));
    const double T = time::to_seconds(span);
    // The rounding of T is made up for by a bump that leaves both ends as they are.
    const double bump = cubics.length_m - 0.5 * T * (w0 + w1);
    const double T2 = T * T, T3 = T2 * T;
    add_phase(leg, cubics,
              {{0.0, w0, 0.0, (w1 - w0) / T2 + 10.0 * bump / T3, -0.5 * (w1 - w0) / T3 - 15.0 * bump / (T3 * T),
                6.0 * bump / (T3 * T2)}},
              span, true);
    return;
  }
  const LegPlan parts = plan(cubics.length_m, w0, w1, *to.leg_speed_m_per_s, options.leg_acceleration_m_per_s2);
  const time::Nanoseconds up = time::from_seconds(parts.ramp_up_s), down = time::from_seconds(parts.ramp_down_s);
  const bool cruises = parts.cruise_s > kShortestCruise_s;
  const time::Nanoseconds cruise = time::from_seconds(cruises ? parts.cruise_s : 0.0);
  const double up_s = time::to_seconds(up), down_s = time::to_seconds(down), cruise_s = time::to_seconds(cruise);
  // Times are rounded: without a cruise its speed makes up for that, with one a bump in it.
  const double top = cruises ? parts.top_m_per_s : (2.0 * cubics.length_m - w0 * up_s - w1 * down_s) / (up_s + down_s);
  const auto ramp = [](double start_m, double v0, double v1, double T) {
    const double T3 = T * T * T, dv = v1 - v0;
    return TimeLaw{{start_m, v0, 0.0, 0.0, 2.5 * dv / T3, -3.0 * dv / (T3 * T), dv / (T3 * T * T)}};
  };
  const double up_m = 0.5 * (w0 + top) * up_s, down_m = 0.5 * (top + w1) * down_s;
  if (up.count() > 0) add_phase(leg, cubics, ramp(0.0, w0, top, up_s), up, !cruises && down.count() == 0);
  if (cruises) {
    const double bump = cubics.length_m - up_m - down_m - top * cruise_s;
    const double T3 = cruise_s * cruise_s * cruise_s;
    add_phase(
        leg, cubics,
        {{up_m, top, 0.0, 10.0 * bump / T3, -15.0 * bump / (T3 * cruise_s), 6.0 * bump / (T3 * cruise_s * cruise_s)}},
        cruise, down.count() == 0);
  }
  if (down.count() > 0) add_phase(leg, cubics, ramp(cubics.length_m - down_m, top, w1, down_s), down, true);
}

void WaypointRoute::add_phase(std::size_t leg, const Cubics& cubics, const TimeLaw& law, time::Nanoseconds span,
                              bool is_last) {
  const nav::PositionSpline& line = runs_[cubics.run].curve.line;
  const double T = time::to_seconds(span);
  const double from_m = law.c[0], to_m = law.value(T);
  const time::Nanoseconds start = duration(), phase_end = start + span;
  phases_.push_back({law, start, phase_end});
  double before_m = 0.0;
  for (std::size_t k = cubics.first; k < cubics.last; ++k) {
    const double after_m = before_m + line.interval(k);
    const bool ends = k + 1 == cubics.last || (!is_last && after_m >= to_m);
    if (ends || after_m > from_m) {
      const time::Nanoseconds end = ends ? phase_end : start + time::from_seconds(time_of(law, after_m, T));
      if (end > duration()) pieces_.push_back({end, leg, cubics.run, k, phases_.size() - 1, before_m, false});
    }
    if (ends) return;
    before_m = after_m;
  }
}

PathPiece WaypointRoute::piece(std::size_t index) const {
  const Stretch& stretch = pieces_[index];
  const nav::PositionSpline& line = runs_[stretch.run].curve.line;
  PathPiece piece;
  piece.start = index == 0 ? time::Nanoseconds(0) : pieces_[index - 1].end;
  piece.end = stretch.end;
  piece.index = static_cast<std::uint32_t>(stretch.leg);
  if (stretch.waits && stretch.cubic == line.pieces()) {
    // Behind the line's end: the last cubic, at its end.
    piece.curve = line.piece(stretch.cubic - 1);
    piece.law.c[0] = line.interval(stretch.cubic - 1);
    return piece;
  }
  piece.curve = line.piece(stretch.cubic);
  if (!stretch.waits) {
    const Phase& phase = phases_[stretch.phase];
    piece.law = shifted(phase.law, time::to_seconds(piece.start - phase.start), stretch.length_m);
  }
  return piece;
}

}  // namespace inslab::scenario
