#include "inslab/scenario/waypoint_route.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::scenario {
namespace waypoint_route_test {

constexpr double kNoLimit = 1e9;

Waypoint waypoint(double latitude_deg, double longitude_deg, double height_m, double speed_m_per_s,
                  double wait_s = 0.0) {
  return {latitude_deg, longitude_deg, height_m, speed_m_per_s, wait_s};
}

/// Over the antimeridian in the south, with waits at both ends and at a stop on the way.
std::vector<Waypoint> tour() {
  return {waypoint(-17.0, 179.98, 10.0, 0.0, 5.0), waypoint(-17.005, 179.995, 60.0, 20.0),
          waypoint(-17.0, -179.99, 100.0, 25.0),   waypoint(-16.99, -179.985, 100.0, 0.0, 3.0),
          waypoint(-16.98, 180.0, 80.0, 15.0),     waypoint(-16.985, 179.985, 20.0, 0.0, 4.0)};
}

nav::Geodetic place(const PathPiece& piece, double t_s) {
  return nav::displaced(piece.curve.origin, piece.curve.displacement_k(piece.law.value(t_s)));
}
double span_s(const PathPiece& piece) { return time::to_seconds(piece.end - piece.start); }

nav::Vector3 in_e(const PathPiece& piece, const nav::Vector3& vector_k) {
  return nav::C_en(piece.curve.origin.latitude_rad, piece.curve.origin.longitude_rad) * vector_k;
}

/// The first piece that leads away from a waypoint.
PathPiece piece_at(const WaypointRoute& route, std::size_t waypoint) {
  for (std::size_t i = 0; i < route.pieces(); ++i) {
    if (route.piece(i).index == waypoint) return route.piece(i);
  }
  return route.piece(route.pieces() - 1);
}

TEST(WaypointRoute, MeetsEveryPlaceAndSpeed) {
  const auto waypoints = tour();
  const WaypointRoute route(waypoints);
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    const PathPiece piece = piece_at(route, k);
    const nav::Geodetic expected{waypoints[k].latitude_deg * units::kDeg,
                                 nav::wrapped_to_pi(waypoints[k].longitude_deg * units::kDeg), waypoints[k].height_m};
    // A longitude of 3 rad is good to 3e-9 m.
    EXPECT_LT(nav::ned_from(expected, place(piece, 0.0)).norm(), 3e-9) << k;
    EXPECT_NEAR(piece.velocity_k(0.0).norm(), waypoints[k].speed_m_per_s, 1e-12) << k;
  }
}

TEST(WaypointRoute, IsContinuousToTheAcceleration) {
  const WaypointRoute route(tour());
  for (std::size_t i = 1; i < route.pieces(); ++i) {
    const PathPiece before = route.piece(i - 1), after = route.piece(i);
    ASSERT_EQ(before.end, after.start);
    // The joints are rounded to 1 ns: 2.5e-8 m at 25 m/s would be seen, so the laws, not the joints, carry the place.
    ASSERT_LT(nav::ned_from(place(before, span_s(before)), place(after, 0.0)).norm(), 5e-9) << i;
    ASSERT_LT((in_e(before, before.velocity_k(span_s(before))) - in_e(after, after.velocity_k(0.0))).norm(), 1e-9);
    ASSERT_LT((in_e(before, before.acceleration_k(span_s(before))) - in_e(after, after.acceleration_k(0.0))).norm(),
              1e-6)
        << i;
  }
}

TEST(WaypointRoute, GoesFromOneSpeedToTheNextWithoutOvershoot) {
  const WaypointRoute route(
      {waypoint(40.0, 10.0, 0.0, 5.0), waypoint(40.005, 10.0, 0.0, 20.0), waypoint(40.008, 10.006, 0.0, 20.0)});
  double last = 5.0;
  for (std::size_t i = 0; i < route.pieces(); ++i) {
    const PathPiece piece = route.piece(i);
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
      const double speed = piece.velocity_k(part * span_s(piece)).norm();
      // The line is measured by its length to 1e-4.
      EXPECT_GT(speed, last - 2e-3);
      EXPECT_LT(speed, 20.0 + 2e-3);
      last = speed;
    }
  }
}

TEST(WaypointRoute, TakesTwiceTheLengthOverTheSumOfTheSpeeds) {
  const WaypointRoute route({waypoint(0.0, 10.0, 0.0, 10.0), waypoint(0.0, 10.01, 0.0, 30.0)});
  const double length_m = 6378137.0 * 0.01 * 3.14159265358979323846 / 180.0;
  EXPECT_NEAR(time::to_seconds(route.duration()), length_m / 20.0, 1e-6);
}

TEST(WaypointRoute, WaitsAtRestForAsLongAsItSays) {
  const WaypointRoute route(tour());
  const PathPiece wait = piece_at(route, 3);
  EXPECT_EQ(wait.end - wait.start, time::Nanoseconds(3000000000));
  EXPECT_EQ(wait.velocity_k(1.0), nav::Vector3::Zero());
  EXPECT_LT(nav::ned_from(place(wait, 0.0), place(wait, 3.0)).norm(), 1e-15);
}

TEST(WaypointRoute, StaysAtTheEndWhenAsked) {
  WaypointRoute route(tour());
  const time::Nanoseconds end = route.duration() + time::Nanoseconds(100);
  route.stay_until(end);
  EXPECT_EQ(route.duration(), end);
  EXPECT_EQ(route.piece(route.pieces() - 1).velocity_k(0.0), nav::Vector3::Zero());
  route.stay_until(time::Nanoseconds(5));
  EXPECT_EQ(route.duration(), end);
}

/// Up, across with a bend in motion, and back to where it came from.
std::vector<Waypoint> hops() {
  std::vector<Waypoint> way{waypoint(47.0, 8.0, 400.0, 0.0, 5.0), waypoint(47.0, 8.0, 440.0, 0.0, 2.0),
                            waypoint(47.002, 8.003, 450.0, 10.0), waypoint(47.001, 8.006, 450.0, 0.0, 2.0),
                            waypoint(47.001, 8.0061, 450.0, 0.0), waypoint(47.0, 8.0, 440.0, 0.0, 1.0)};
  for (const std::size_t k : {1U, 2U, 3U, 4U, 5U}) way[k].leg_speed_m_per_s = k == 1 ? 4.0 : 15.0;
  return way;
}
constexpr RouteOptions kHops{2.0, true};

TEST(WaypointRoute, HopsFromStopToStopAtItsLegSpeeds) {
  const std::vector<Waypoint> waypoints = hops();
  EXPECT_FALSE(violation(waypoints, 5.0, kHops).has_value());
  const WaypointRoute route(waypoints, kHops);
  double top = 0.0, top_of_hop = 0.0, largest = 0.0;
  nav::Vector3 v_e = nav::Vector3::Zero(), a_e = nav::Vector3::Zero();
  for (std::size_t i = 0; i < route.pieces(); ++i) {
    const PathPiece piece = route.piece(i);
    ASSERT_LT((in_e(piece, piece.velocity_k(0.0)) - v_e).norm(), 1e-6) << i;
    ASSERT_LT((in_e(piece, piece.acceleration_k(0.0)) - a_e).norm(), 1e-5) << i;
    for (int j = 0; j <= 20; ++j) {
      const double t_s = 0.05 * j * span_s(piece);
      const double speed = piece.velocity_k(t_s).norm();
      if (piece.index == 1 || piece.index == 2) top = std::max(top, speed);
      if (piece.index == 3) top_of_hop = std::max(top_of_hop, speed);
      if (piece.index == 0) largest = std::max(largest, piece.acceleration_k(t_s).norm());
      ASSERT_LT(speed, 15.0 * 1.0002);
    }
    v_e = in_e(piece, piece.velocity_k(span_s(piece)));
    a_e = in_e(piece, piece.acceleration_k(span_s(piece)));
  }
  EXPECT_NEAR(top, 15.0, 2e-3);
  // 7.6 m do not suffice for 15 m/s: two ramps of v^2 1.875/(2 a) each.
  EXPECT_NEAR(top_of_hop, std::sqrt(7.6 * 2.0 / 1.875), 0.02);
  EXPECT_NEAR(largest, 2.0, 2e-3);
  EXPECT_NEAR(v_e.norm(), 0.0, 1e-9);
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    EXPECT_NEAR(time::to_seconds(route.departure(k) - route.arrival(k)), waypoints[k].wait_s, 1e-9) << k;
  }
}

TEST(WaypointRoute, LeavesAStopInAnyDirectionOnlyWhenStopsPart) {
  const std::vector<Waypoint> waypoints = hops();
  const WaypointRoute route(waypoints, kHops);
  ASSERT_EQ(WaypointRoute::runs_of(waypoints, kHops).size(), 4U);
  // The first leg is vertical to the last bit of the position.
  for (std::size_t i = 0; i < route.pieces() && route.piece(i).index == 0; ++i) {
    const PathPiece piece = route.piece(i);
    const nav::Vector3 v = piece.velocity_k(0.5 * span_s(piece));
    ASSERT_LT(std::hypot(v.x(), v.y()), 1e-9) << i;
  }
  EXPECT_EQ(WaypointRoute::runs_of(tour(), {}).size(), 1U) << "its stop on the way is passed on one curve";
}

TEST(WaypointRules, RefuseALegSpeedThatItsLegCannotKeep) {
  std::vector<Waypoint> waypoints = hops();
  waypoints[2].leg_speed_m_per_s = 9.0;
  EXPECT_EQ(violation(waypoints, kNoLimit, kHops)->path, "waypoints[2].leg_speed_m_per_s");
  waypoints = {waypoint(47.0, 8.0, 0.0, 0.0), waypoint(47.0, 8.0001, 0.0, 15.0)};
  waypoints[1].leg_speed_m_per_s = 20.0;
  EXPECT_EQ(violation(waypoints, kNoLimit, kHops)->rule, Rule::WaypointLegSpeed);
  waypoints[1].leg_speed_m_per_s.reset();
  waypoints[1].speed_m_per_s = 0.0;
  EXPECT_EQ(violation(waypoints, kNoLimit, kHops)->rule, Rule::WaypointSpeeds);
}

TEST(WaypointRules, AcceptATour) { EXPECT_FALSE(violation(tour(), kNoLimit).has_value()); }

Rule rule_of(const std::vector<Waypoint>& waypoints, double limit = kNoLimit) {
  const auto broken = violation(waypoints, limit);
  return broken ? broken->rule : Rule::ValidJson;
}

TEST(WaypointRules, RefuseWhatIsNoPath) {
  EXPECT_EQ(rule_of({}), Rule::WaypointCount);
  EXPECT_EQ(rule_of({waypoint(1.0, 2.0, 0.0, 5.0)}), Rule::WaypointCount);
  EXPECT_EQ(rule_of({waypoint(1.0, 2.0, 0.0, 5.0), waypoint(1.0, 2.0, 0.5, 5.0)}), Rule::WaypointsApart);
  EXPECT_EQ(rule_of({waypoint(1.0, 2.0, 0.0, 5.0), waypoint(1.0, 9.0, 0.0, 5.0)}), Rule::WaypointsApart);
}

TEST(WaypointRules, RefuseALegWithoutSpeedAndAWaitInMotion) {
  auto waypoints = tour();
  waypoints[4].speed_m_per_s = 0.0;
  EXPECT_EQ(violation(waypoints, kNoLimit)->path, "waypoints[4].speed_m_per_s");
  waypoints = tour();
  waypoints[1].wait_s = 1.0;
  EXPECT_EQ(violation(waypoints, kNoLimit)->path, "waypoints[1].wait_s");
}

TEST(WaypointRules, RefuseAPathThatTurnsBackAndNameTheWaypoint) {
  const std::vector<Waypoint> there_and_back{waypoint(1.0, 2.0, 0.0, 5.0), waypoint(1.0, 2.01, 0.0, 5.0),
                                             waypoint(1.0, 2.02, 0.0, 5.0), waypoint(1.0, 2.005, 0.0, 5.0)};
  const auto broken = violation(there_and_back, kNoLimit);
  ASSERT_TRUE(broken.has_value());
  EXPECT_EQ(broken->rule, Rule::WaypointTurn);
  EXPECT_EQ(broken->path, "waypoints[2]");
}

TEST(WaypointRules, RefuseAPathThatTurnsBackOnTheSpotWhereItHasNoSlope) {
  std::vector<Waypoint> out_and_home{waypoint(1.0, 2.0, 0.0, 0.0), waypoint(1.0, 2.01, 0.0, 5.0),
                                     waypoint(1.0, 2.0, 0.0, 0.0)};
  for (Waypoint& each : out_and_home) each.leg_speed_m_per_s = 6.0;
  const auto broken = violation(out_and_home, kNoLimit);
  ASSERT_TRUE(broken.has_value());
  EXPECT_EQ(broken->rule, Rule::WaypointTurn);
  EXPECT_EQ(broken->path, "waypoints[1]");
}

TEST(WaypointRules, RefuseAnAccelerationAboveTheLimitAndNameTheLeg) {
  // 10 to 30 m/s over 222.6 m takes 11.13 s; the greatest acceleration, half-way, is 1.5 times the mean: 2.7 m/s^2.
  const std::vector<Waypoint> dash{waypoint(0.0, 2.0, 0.0, 10.0), waypoint(0.0, 2.002, 0.0, 30.0)};
  EXPECT_EQ(rule_of(dash, 2.75), Rule::ValidJson);
  EXPECT_EQ(rule_of(dash, 2.65), Rule::WaypointAcceleration);
}

TEST(WaypointRules, RefuseMoreThanABillionSeconds) {
  EXPECT_EQ(rule_of({waypoint(0.0, 2.0, 0.0, 1e-7), waypoint(0.0, 2.002, 0.0, 1e-7)}), Rule::TrajectoryLength);
}

}  // namespace waypoint_route_test
}  // namespace inslab::scenario
