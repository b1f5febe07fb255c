#include "scenario/waypoint_route.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace inslab::scenario {

namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kClosest_m = 1.0;
constexpr double kFarthest_m = 500e3;
constexpr double kLongest_s = 1e9;
// Where the line turns back on itself, its slope by its own length vanishes.
constexpr double kLeastSlope = 0.5;

nav::Geodetic position(const Waypoint& waypoint) {
  return {waypoint.latitude_deg * kRadPerDeg, nav::wrapped_to_pi(waypoint.longitude_deg * kRadPerDeg),
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

std::optional<Violation> leg_violation(const std::vector<Waypoint>& waypoints) {
  double total_s = waypoints.front().wait_s;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    const double distance_m = nav::ned_from(position(waypoints[k - 1]), position(waypoints[k])).norm();
    if (!(distance_m >= kClosest_m && distance_m <= kFarthest_m)) {
      return Violation{Rule::WaypointsApart, at(k, ""),
                       text_of("lies ", distance_m, " m from the one before; expected ", kClosest_m, " m to ",
                               kFarthest_m / 1e3, " km")};
    }
    const double both_m_per_s = waypoints[k - 1].speed_m_per_s + waypoints[k].speed_m_per_s;
    if (both_m_per_s == 0.0) {
      return Violation{Rule::WaypointSpeeds, at(k, "speed_m_per_s"),
                       "is 0, as at the waypoint before: the leg between them would never end"};
    }
    total_s += 2.0 * distance_m / both_m_per_s + waypoints[k].wait_s;
    if (!(total_s <= kLongest_s)) {
      return Violation{Rule::TrajectoryLength, at(k, "speed_m_per_s"), "brings the total above 1e9 s"};
    }
  }
  return std::nullopt;
}

std::optional<Violation> turn_violation(const nav::SurfaceCurve& curve) {
  std::size_t nearest = 0;
  for (std::size_t k = 0; k <= curve.line.pieces(); ++k) {
    const std::size_t next = std::min(nearest + 1, curve.index_of_point.size() - 1);
    if (2 * k > curve.index_of_point[nearest] + curve.index_of_point[next]) nearest = next;
    if (!(curve.line.slope_e(k).norm() >= kLeastSlope)) {
      return Violation{Rule::WaypointTurn, at(nearest, ""),
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

std::optional<Violation> violation(const std::vector<Waypoint>& waypoints, double max_acceleration_m_per_s2) {
  if (auto broken = single_violation(waypoints)) return broken;
  if (auto broken = leg_violation(waypoints)) return broken;
  const WaypointRoute route(waypoints);
  if (auto broken = turn_violation(route.curve())) return broken;
  return acceleration_violation(route, max_acceleration_m_per_s2);
}

WaypointRoute::WaypointRoute(const std::vector<Waypoint>& waypoints)
    : curve_(nav::surface_curve(positions(waypoints))) {
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    if (k > 0) add_leg(k - 1, waypoints[k - 1].speed_m_per_s, waypoints[k].speed_m_per_s);
    add_wait(k, time::from_seconds(waypoints[k].wait_s));
  }
}

void WaypointRoute::stay_until(time::Nanoseconds end) {
  if (end > duration()) add_wait(legs_.size(), end - duration());
}

void WaypointRoute::add_wait(std::size_t waypoint, time::Nanoseconds duration) {
  if (duration.count() <= 0) return;
  const time::Nanoseconds start = pieces_.empty() ? time::Nanoseconds(0) : pieces_.back().end;
  pieces_.push_back({start + duration, waypoint, curve_.index_of_point[waypoint], 0.0, true});
}

void WaypointRoute::add_leg(std::size_t leg, double v0_m_per_s, double v1_m_per_s) {
  const nav::PositionSpline& line = curve_.line;
  const std::size_t first = curve_.index_of_point[leg], last = curve_.index_of_point[leg + 1];
  double length_m = 0.0;
  for (std::size_t k = first; k < last; ++k) length_m += line.interval(k);
  // By the parameter: the line's slope is nearly, not exactly, of length 1.
  const double w0 = v0_m_per_s / line.slope_e(first).norm(), w1 = v1_m_per_s / line.slope_e(last).norm();
  const time::Nanoseconds span = time::from_seconds(2.0 * length_m / (w0 + w1));
  const double T = time::to_seconds(span);
  // The rounding of T is made up for by a bump that leaves both ends as they are.
  const double bump = length_m - 0.5 * T * (w0 + w1);
  const double T2 = T * T, T3 = T2 * T;
  const time::Nanoseconds start = pieces_.empty() ? time::Nanoseconds(0) : pieces_.back().end;
  legs_.push_back({{{0.0, w0, 0.0, (w1 - w0) / T2 + 10.0 * bump / T3, -0.5 * (w1 - w0) / T3 - 15.0 * bump / (T3 * T),
                     6.0 * bump / (T3 * T2)}},
                   start,
                   start + span});
  double before_m = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    const double after_m = before_m + line.interval(k);
    const time::Nanoseconds end =
        k + 1 == last ? start + span : start + time::from_seconds(time_of(legs_.back().law, after_m, T));
    if (end > (pieces_.empty() ? start : pieces_.back().end)) pieces_.push_back({end, leg, k, before_m, false});
    before_m = after_m;
  }
}

PathPiece WaypointRoute::piece(std::size_t index) const {
  const Stretch& stretch = pieces_[index];
  PathPiece piece;
  piece.start = index == 0 ? time::Nanoseconds(0) : pieces_[index - 1].end;
  piece.end = stretch.end;
  piece.index = static_cast<std::uint32_t>(stretch.leg);
  if (stretch.waits && stretch.cubic == curve_.line.pieces()) {
    // Behind the line's end: the last cubic, at its end.
    piece.curve = curve_.line.piece(stretch.cubic - 1);
    piece.law.c[0] = curve_.line.interval(stretch.cubic - 1);
    return piece;
  }
  piece.curve = curve_.line.piece(stretch.cubic);
  if (!stretch.waits) {
    const Leg& leg = legs_[stretch.leg];
    piece.law = shifted(leg.law, time::to_seconds(piece.start - leg.start), stretch.length_m);
  }
  return piece;
}

}  // namespace inslab::scenario
