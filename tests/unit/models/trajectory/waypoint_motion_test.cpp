#include "inslab/models/trajectory/waypoint_motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::trajectory {
namespace waypoint_motion_test {

scenario::Trajectory along(std::vector<scenario::Waypoint> waypoints) {
  scenario::Trajectory trajectory;
  trajectory.source = scenario::TrajectorySource::Waypoints;
  trajectory.waypoints = std::move(waypoints);
  return trajectory;
}

/// From rest over the antimeridian in the south, round a bend, and to rest again.
scenario::Trajectory tour() {
  return along({{-17.0, 179.99, 10.0, 0.0, 20.0},
                {-17.003, 179.998, 60.0, 20.0, 0.0},
                {-17.0, -179.994, 100.0, 25.0, 0.0},
                {-16.99, -179.99, 100.0, 20.0, 0.0},
                {-16.985, -179.997, 80.0, 0.0, 0.0}});
}

std::vector<TruthState> run(const scenario::Trajectory& trajectory, double rate_hz, double seconds) {
  const time::Nanoseconds end = time::from_seconds(seconds);
  SmoothModel model(motion_along_waypoints(trajectory, end), "waypoint", nav::Gravity(), time::Rate(rate_hz),
                    {2300, 0});
  std::vector<TruthState> truth{model.current()};
  while (time::Rate(rate_hz).at(truth.size()) <= end) truth.push_back(model.advance());
  return truth;
}

TEST(WaypointMotion, PassesEveryWaypointAtItsSpeed) {
  const scenario::Trajectory trajectory = tour();
  const auto truth = run(trajectory, 1000.0, 320.0);
  for (std::size_t k = 1; k < trajectory.waypoints.size(); ++k) {
    // The first sample of the leg that begins there is up to 1 ms late: 25 mm at 25 m/s, 2e-3 m/s at 2 m/s^2.
    const scenario::Waypoint& waypoint = trajectory.waypoints[k];
    std::size_t i = 0;
    while (i < truth.size() && truth[i].segment_index < k) ++i;
    ASSERT_LT(i, truth.size());
    const nav::Geodetic expected{waypoint.latitude_deg * units::kDeg, waypoint.longitude_deg * units::kDeg,
                                 waypoint.height_m};
    EXPECT_LT(nav::ned_from(expected, geodetic_of(truth[i])).norm(), 0.025 + 1e-6) << k;
    EXPECT_NEAR(truth[i].v_n.norm(), waypoint.speed_m_per_s, 2e-3) << k;
  }
}

TEST(WaypointMotion, PointsItsNoseAlongThePathAndAtRestWhereItWillGo) {
  const auto truth = run(tour(), 20.0, 320.0);
  for (const TruthState& sample : truth) {
    if (sample.v_n.norm() < 0.1) continue;
    const Vector3 nose_n = nav::matrix_from_quaternion(sample.q_nv) * Vector3::UnitX();
    // Between attitudes 2 deg apart the rotation spline leaves the path's by some 1e-5 rad.
    ASSERT_LT((nose_n - sample.v_n.normalized()).norm(), 1e-4) << sample.header.sim_time_ns;
  }
  const double yaw_at_rest = nav::rpy_from_quaternion(truth.front().q_nv).yaw_rad;
  std::size_t i = 0;
  while (truth[i].v_n.norm() < 1.0) ++i;
  EXPECT_NEAR(yaw_at_rest, std::atan2(truth[i].v_n.y(), truth[i].v_n.x()), 2e-2);
}

TEST(WaypointMotion, StandsStillWhileItWaitsAndAtTheEnd) {
  const auto truth = run(tour(), 20.0, 400.0);
  const Vector3 earth_rate = truth[100].omega_iv_v;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t_s = time::to_seconds(truth[i].header.sim_time_ns);
    if (t_s > 20.0 && t_s < 330.0) continue;
    ASSERT_EQ(truth[i].v_n.norm(), 0.0) << t_s;
    // What the attitude's spline rings on with falls to 0.27 of itself from one interval of the wait to the next.
    if (t_s < 17.0) {
      ASSERT_LT((truth[i].omega_iv_v - earth_rate).norm(), 1e-7) << t_s;
    }
  }
}

TEST(WaypointMotion, VelocityIsTheDerivativeOfThePosition) {
  const auto truth = run(tour(), 200.0, 320.0);
  for (std::size_t i = 2; i + 2 < truth.size(); ++i) {
    const nav::Geodetic here = geodetic_of(truth[i]);
    const auto way = [&](std::size_t j) { return nav::ned_from(here, geodetic_of(truth[j])); };
    const Vector3 velocity = (8.0 * (way(i + 1) - way(i - 1)) - (way(i + 2) - way(i - 2))) / 60e-3;
    ASSERT_LT((velocity - truth[i].v_n).norm(), 2e-6) << i;
  }
}

TEST(WaypointMotion, RateAndSpecificForceAreContinuous) {
  // Jerks of some 1 m/s^3 and angular accelerations of some 0.1 rad/s^2 over 5 ms.
  const auto truth = run(tour(), 200.0, 320.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    ASSERT_LT((truth[i].f_v - truth[i - 1].f_v).norm(), 2e-2) << i;
    ASSERT_LT((truth[i].omega_iv_v - truth[i - 1].omega_iv_v).norm(), 2e-3) << i;
  }
}

TEST(WaypointMotion, IncrementsDoNotDependOnTheGrid) {
  const auto coarse = run(tour(), 200.0, 320.0), fine = run(tour(), 1000.0, 320.0);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    Vector3 dtheta = Vector3::Zero(), dv = Vector3::Zero();
    for (std::size_t j = 5 * i - 4; j <= 5 * i; ++j) {
      dtheta += fine[j].dtheta_v;
      dv += fine[j].dv_v;
    }
    ASSERT_LT((dtheta - coarse[i].dtheta_v).norm(), 2.5e-15) << i;
    ASSERT_LT((dv - coarse[i].dv_v).norm(), 5e-14) << i;
  }
}

TEST(WaypointMotion, FollowsTheGroundOverALongLeg) {
  const auto truth = run(along({{48.0, 2.0, 10000.0, 240.0, 0.0}, {52.0, 4.0, 10000.0, 240.0, 0.0}}), 1.0, 1900.0);
  for (const TruthState& sample : truth) {
    ASSERT_NEAR(sample.height_m, 10000.0, 1e-7);
    ASSERT_NEAR(sample.v_n.norm(), 240.0, 1e-4);
    ASSERT_NEAR(nav::rpy_from_quaternion(sample.q_nv).pitch_rad, 0.0, 1e-6);
  }
}

/// A leg of 11 h in a run of 5 min: the whole of it would ask a ship's law for some 40,000 attitudes.
TEST(WaypointMotion, TakesNoAttitudesFarBeyondTheRun) {
  scenario::Trajectory voyage =
      along({{60.0, 5.0, 0.0, 0.0, 10.0}, {60.02, 5.01, 0.0, 8.0, 0.0}, {63.0, 4.0, 0.0, 8.0, 0.0}});
  voyage.attitude_from_path.vehicle_class = scenario::VehicleClass::Ship;
  const SmoothMotion short_run = motion_along_waypoints(voyage, time::from_seconds(300.0));
  EXPECT_LT(short_run.attitude->pieces(), 1000u);
  EXPECT_GT(short_run.attitude->end(short_run.attitude->pieces() - 1), time::from_seconds(300.0));

  SmoothModel brief(motion_along_waypoints(voyage, time::from_seconds(300.0)), "waypoint", nav::Gravity(),
                    time::Rate(1.0), {2300, 0});
  SmoothModel whole(motion_along_waypoints(voyage, time::from_seconds(40000.0)), "waypoint", nav::Gravity(),
                    time::Rate(1.0), {2300, 0});
  for (int i = 0; i < 300; ++i) {
    const TruthState expected = whole.advance();
    const TruthState got = brief.advance();
    ASSERT_LT(nav::angle_between(got.q_nv, expected.q_nv), 1e-12) << i;
    ASSERT_LT((got.omega_iv_v - expected.omega_iv_v).norm(), 1e-13) << i;
  }
}

TEST(WaypointMotion, RefusesWaypointsThatBreakARule) {
  EXPECT_THROW(motion_along_waypoints(along({{1.0, 2.0, 0.0, 5.0, 0.0}}), time::Nanoseconds(1)), std::invalid_argument);
}

}  // namespace waypoint_motion_test
}  // namespace inslab::trajectory
