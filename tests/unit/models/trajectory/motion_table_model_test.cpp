#include "inslab/models/trajectory/motion_table_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace motion_table_model_test {

using namespace tables;

const time::GpsTime kStart{2300, 604'799'000'000'000};

TruthState after(MotionTableModel& model, int steps) {
  TruthState truth = model.current();
  for (int i = 0; i < steps; ++i) truth = model.advance();
  return truth;
}
TruthState truth_after(const Trajectory& trajectory, double seconds) {
  MotionTableModel model(trajectory, time::Rate(200.0), kStart);
  return after(model, static_cast<int>(std::lround(seconds * 200.0)));
}
nav::RollPitchYaw rpy(const TruthState& truth) { return nav::rpy_from_quaternion(truth.q_nv); }

TEST(MotionTableModel, BeginsWithTheScenariosState) {
  Trajectory t = at_wuhan();
  t.initial.speed_m_per_s = 10.0;
  t.initial.roll_deg = 1.0;
  const TruthState truth = MotionTableModel(t, time::Rate(200.0), kStart).current();
  EXPECT_DOUBLE_EQ(truth.latitude_rad, 30.53 * units::kDeg);
  EXPECT_DOUBLE_EQ(truth.longitude_rad, 114.35 * units::kDeg);
  EXPECT_EQ(truth.height_m, 20.0);
  EXPECT_NEAR(truth.v_n.x(), 10.0 * std::cos(30.0 * units::kDeg), 1e-14);
  EXPECT_NEAR(truth.v_n.y(), 10.0 * std::sin(30.0 * units::kDeg), 1e-14);
  EXPECT_NEAR(rpy(truth).roll_rad, units::kDeg, 1e-15);
  EXPECT_EQ(truth.interval_ns, 0);
  EXPECT_EQ(truth.dtheta_v, Vector3::Zero());
  EXPECT_EQ(truth.dv_v, Vector3::Zero());
  EXPECT_EQ(truth.header.sequence_number, 0U);
  EXPECT_EQ(truth.header.gps_week, 2300U);
  EXPECT_FALSE(truth.rate_jump);
}

TEST(MotionTableModel, CountsSamplesOnTheGridAndCarriesTheWeek) {
  MotionTableModel model(at_wuhan(), time::Rate(200.0), kStart);
  const TruthState truth = after(model, 201);
  EXPECT_EQ(truth.header.sequence_number, 201U);
  EXPECT_EQ(truth.header.sim_time_ns, 1'005'000'000);
  EXPECT_EQ(truth.interval_ns, 5'000'000);
  EXPECT_EQ(truth.header.gps_week, 2301U);
  EXPECT_EQ(truth.header.gps_time_of_week_ns, 5'000'000);
}

TEST(MotionTableModel, AtRestFeelsTheEarthsRateAndGravityAlone) {
  Trajectory t = at_wuhan(135.0);
  t.initial.pitch_deg = 3.0;
  MotionTableModel model(t, time::Rate(200.0), kStart);
  const TruthState first = model.current();
  const TruthState truth = after(model, 200 * 60);
  const Matrix3 C_vn = nav::matrix_from_quaternion(truth.q_nv).transpose();
  const double dt_s = 0.005;
  // Roundings of numbers of 4e-7 rad and 0.05 m/s.
  EXPECT_LT((truth.dtheta_v - C_vn * nav::omega_ie_n(first.latitude_rad) * dt_s).norm(), 1e-21);
  const Vector3 g_n = nav::Gravity(nav::GravityModel::Normal).g_n(geodetic_of(first));
  EXPECT_LT((truth.dv_v + C_vn * g_n * dt_s).norm(), 3e-17);
  EXPECT_LT((truth.f_v + C_vn * g_n).norm(), 5e-15);
  EXPECT_EQ(truth.latitude_rad, first.latitude_rad);
  EXPECT_EQ(truth.longitude_rad, first.longitude_rad);
  EXPECT_EQ(truth.height_m, first.height_m);
  EXPECT_EQ(truth.q_nv.coeffs(), first.q_nv.coeffs());
}

TEST(MotionTableModel, TakesTheScenariosGravity) {
  Trajectory t = at_wuhan();
  t.gravity.model = nav::GravityModel::Series;
  t.gravity.disturbance_mgal = 50.0;
  const TruthState truth = MotionTableModel(t, time::Rate(200.0), kStart).current();
  const nav::Geodetic position = geodetic_of(truth);
  EXPECT_NEAR(-truth.f_v.z(), nav::Gravity(nav::GravityModel::Series).g_n(position).z() + 50e-5, 1e-14);
}

TEST(MotionTableModel, ConstantVelocityNorthFollowsTheMeridian) {
  // The time that a meridian arc takes at 100 m/s is the integral of (M + h)/v: Simpson on 1000 pieces of the 6 km arc,
  // whose own error is (1e-6 rad)^4.
  Trajectory t = at_wuhan(0.0);
  t.initial.speed_m_per_s = 100.0;
  const TruthState truth = truth_after(t, 60.0);
  const double start = 30.53 * units::kDeg, h = (truth.latitude_rad - start) / 2000.0;
  double arc_m = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double at = start + 2.0 * h * i;
    arc_m += h / 3.0 *
             (nav::wgs84::meridian_radius_m(at) + 4.0 * nav::wgs84::meridian_radius_m(at + h) +
              nav::wgs84::meridian_radius_m(at + 2.0 * h) + 6.0 * 20.0);
  }
  // Half units in the last place of two latitudes are 7e-10 m; the sums of the arc add 1e-9 m.
  EXPECT_NEAR(arc_m, 6000.0, 2e-9);
  EXPECT_NEAR(truth.v_n.x(), 100.0, 1e-13);
  EXPECT_EQ(truth.height_m, 20.0);
}

TEST(MotionTableModel, ConstantVelocityEastTurnsByTheEarthAndTheTransportRate) {
  Trajectory t = at_wuhan(90.0);
  t.initial.speed_m_per_s = 50.0;
  const TruthState truth = truth_after(t, 10.0);
  const nav::Geodetic position = geodetic_of(truth);
  const Matrix3 C_vn = nav::matrix_from_quaternion(truth.q_nv).transpose();
  const Vector3 omega = nav::omega_ie_n(truth.latitude_rad) + nav::omega_en_n(position, truth.v_n);
  EXPECT_LT((truth.omega_iv_v - C_vn * omega).norm(), 1e-19);
  EXPECT_LT((truth.dtheta_v - C_vn * omega * 0.005).norm(), 1e-21);
  const double longitude_rate =
      50.0 / ((nav::wgs84::transverse_radius_m(truth.latitude_rad) + 20.0) * std::cos(truth.latitude_rad));
  // v_N is 50 cos(90 deg) = 3e-15 m/s: latitude stays. Half a unit in the last place of two longitudes near 2 rad.
  EXPECT_NEAR(truth.longitude_rad - 114.35 * units::kDeg, 10.0 * longitude_rate, 5e-16);
}

TEST(MotionTableModel, TurnReachesItsAngleAndKeepsTheSpeedOnTheNose) {
  Trajectory t = at_wuhan(30.0);
  t.initial.speed_m_per_s = 12.0;
  t.segments = {segment(7.0031, {turn(90.0)})};
  const TruthState truth = truth_after(t, 8.0);
  EXPECT_NEAR(rpy(truth).yaw_rad, 120.0 * units::kDeg, 4e-15);
  EXPECT_NEAR(truth.v_n.x(), 12.0 * std::cos(120.0 * units::kDeg), 5e-14);
  EXPECT_NEAR(truth.v_n.y(), 12.0 * std::sin(120.0 * units::kDeg), 5e-14);
}

TEST(MotionTableModel, RightTurnPushesToTheRight) {
  Trajectory t = at_wuhan();
  t.initial.speed_m_per_s = 10.0;
  t.segments = {segment(20.0, {constant_rate(10.0)})};
  // a_v = omega x v_v = +y; Coriolis adds 2 omega_e v = 1.5e-3 m/s^2 at most.
  EXPECT_NEAR(truth_after(t, 5.0).f_v.y(), 10.0 * 10.0 * units::kDeg, 2e-3);
}

TEST(MotionTableModel, VelocityKeepsItsDirectionWhenNotOnTheNose) {
  Trajectory t = at_wuhan(0.0);
  t.initial.speed_m_per_s = 10.0;
  t.segments = {segment(10.0, {turn(90.0)})};
  t.segments[0].keep_velocity_on_nose = false;
  const TruthState truth = truth_after(t, 10.0);
  EXPECT_EQ(truth.v_n, Vector3(10.0, 0.0, 0.0));
  EXPECT_NEAR(rpy(truth).yaw_rad, 90.0 * units::kDeg, 4e-15);
}

TEST(MotionTableModel, DeltaSpeedAndTargetSpeedReachTheirSpeeds) {
  Trajectory t = at_wuhan(0.0);
  t.initial.speed_m_per_s = 3.0;
  t.segments = {segment(4.00007, {delta_speed(5.0)}), segment(6.0, {target_speed(2.5)})};
  MotionTableModel model(t, time::Rate(200.0), kStart);
  // Sample 801 lies 4.93 ms into the rise of the next acceleration, whose slope is (2.5 - 8)/4.5/1.5 m/s^3.
  EXPECT_NEAR(after(model, 801).v_n.x(), 8.0 - 0.5 * 5.5 / 4.5 / 1.5 * 4.93e-3 * 4.93e-3, 1e-14);
  EXPECT_NEAR(after(model, 1200).v_n.x(), 2.5, 1e-14);
}

TEST(MotionTableModel, TargetSpeedStartsFromTheActualSpeedAlongItsAxis) {
  Trajectory t = at_wuhan(0.0);
  Motion sideways = target_speed(-2.0);
  sideways.axis = Axis::Y;
  t.segments = {segment(3.0, {delta_speed(5.0), sideways}), segment(3.0, {target_speed(1.0)})};
  const TruthState truth = truth_after(t, 6.0);
  EXPECT_LT((truth.v_n - Vector3(1.0, -2.0, 0.0)).norm(), 1e-14);
}

TEST(MotionTableModel, GoesOnAsItIsAfterTheLastSegment) {
  Trajectory t = at_wuhan(0.0);
  t.segments = {segment(2.0, {delta_speed(5.0)})};
  MotionTableModel model(t, time::Rate(200.0), kStart);
  EXPECT_EQ(after(model, 399).segment_index, 0U);
  EXPECT_EQ(after(model, 1).segment_index, 1U);
  const TruthState later = after(model, 2000);
  EXPECT_NEAR(later.v_n.x(), 5.0, 1e-14);
  EXPECT_EQ(later.segment_index, 1U);
}

TEST(MotionTableModel, FlagsARateThatJumpsAtTheEndOfAnIntervalAndReportsTheValueAfterIt) {
  Trajectory t = at_wuhan(0.0);
  t.segments = {segment(1.0), segment(1.0, {constant_rate(10.0)}), segment(1.0, {turn(30.0)})};
  MotionTableModel model(t, time::Rate(200.0), kStart);
  EXPECT_FALSE(after(model, 199).rate_jump);
  const TruthState at_jump = after(model, 1);
  EXPECT_TRUE(at_jump.rate_jump);
  EXPECT_NEAR(at_jump.omega_iv_v.z(), 10.0 * units::kDeg, 1e-4);
  EXPECT_NEAR(at_jump.dtheta_v.z(), 0.0, 1e-6);
  EXPECT_FALSE(after(model, 1).rate_jump);
  EXPECT_TRUE(after(model, 199).rate_jump);   // from 10 deg/s to a turn that starts from 0
  EXPECT_FALSE(after(model, 200).rate_jump);  // a turn ends at 0
}

TEST(MotionTableModel, CrossesTheAntimeridian) {
  Trajectory t = at_wuhan(90.0);
  t.initial.longitude_deg = 179.9999;
  t.initial.speed_m_per_s = 100.0;
  EXPECT_NEAR(truth_after(t, 1.0).longitude_rad, -3.14159, 1e-4);
}

TEST(MotionTableModel, LeavingTheDomainNamesTimeAndQuantity) {
  Trajectory t = at_wuhan();
  t.initial.height_m = 99'990.0;
  t.initial.pitch_deg = 90.0;
  t.initial.speed_m_per_s = 100.0;
  t.segments = {segment(1.0)};
  t.segments[0].name = "climb";
  try {
    truth_after(t, 1.0);
    FAIL() << "left the domain unnoticed";
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("at 0.105000 s, segment 0 'climb': height is 100000.5 m, outside"));
  }
}

TEST(MotionTableModel, RefusesABrokenTableAndAStartOutsideTheDomain) {
  Trajectory t = at_wuhan();
  t.segments = {segment(5.0, {target_speed(10.0), delta_speed(1.0)})};
  EXPECT_THROW(MotionTableModel(t, time::Rate(200.0), kStart), std::invalid_argument);
  t = at_wuhan();
  t.initial.latitude_deg = 89.95;
  EXPECT_THROW(MotionTableModel(t, time::Rate(200.0), kStart), std::domain_error);
}

}  // namespace motion_table_model_test
}  // namespace inslab::trajectory
