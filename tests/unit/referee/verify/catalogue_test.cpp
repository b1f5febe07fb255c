// Every scenario of the catalogue: what its file promises, smoothness where segments meet, and the published quantities
// as derivatives of each other.

#include "inslab/referee/verify/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/referee/verify/smoothness.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::verify {
namespace catalogue_test {

constexpr double kStep_s = 5e-3;

scenario::LoadedScenario loaded(const std::string& name) {
  return scenario::load(std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "scenarios" / (name + ".json"));
}

trajectory::MotionTableModel model_of(const scenario::Trajectory& trajectory) {
  return trajectory::MotionTableModel(trajectory, time::Rate(1.0 / kStep_s), {2300, 0});
}

TEST(Catalogue, IsTwentyMinutesOfEachMotionButTheProjectile) {
  const std::set<std::string> names(catalogue().begin(), catalogue().end());
  EXPECT_EQ(names, (std::set<std::string>{"static", "basic", "vehicle", "ship", "aircraft", "projectile", "circle", "s",
                                          "l", "cross", "figure8"}));
  for (const std::string& name : catalogue()) {
    const scenario::Scenario scenario = catalogue_scenario(name);
    EXPECT_EQ(scenario.name, name);
    EXPECT_FALSE(scenario.imu.empty() || scenario.gnss.empty()) << name;
    if (name == "projectile") continue;
    EXPECT_EQ(scenario.duration_s, 1200.0) << name;
    double total_s = 0.0;
    for (const scenario::Segment& segment : scenario.trajectory.segments) total_s += segment.duration_s;
    EXPECT_NEAR(total_s, 1200.0, 1e-9) << name;
  }
}

TEST(Catalogue, BasicHasEveryMotionOfTheTable) {
  std::set<scenario::MotionType> seen{scenario::MotionType::Uniform};
  for (const auto& segment : catalogue_scenario("basic").trajectory.segments) {
    for (const auto& motion : segment.motions) seen.insert(motion.type);
  }
  EXPECT_EQ(seen.size(), EnumNames<scenario::MotionType>::numbers.size());
}

TEST(Catalogue, MatrixMovesAsBasicToTheBit) {
  const scenario::LoadedScenario matrix = loaded("matrix");
  EXPECT_TRUE(matrix.scenario.trajectory.segments_file.empty()) << "what was read stands in the segments";
  auto from_matrix = model_of(matrix.scenario.trajectory);
  auto from_segments = model_of(catalogue_scenario("basic").trajectory);
  for (int i = 0; i < 240000; ++i) {
    const TruthState a = from_matrix.advance(), b = from_segments.advance();
    ASSERT_EQ(a.latitude_rad, b.latitude_rad) << i;
    ASSERT_EQ(a.dv_v, b.dv_v) << i;
    ASSERT_EQ(a.dtheta_v, b.dtheta_v) << i;
  }
}

TEST(Catalogue, ProjectilesRunEndsBackAtLaunchHeight) {
  const scenario::LoadedScenario scenario = loaded("projectile");
  sim::TruthSource source(scenario, {2300, 0}, RunId{});
  TruthState truth;
  while (source.has_next()) {
    truth = source.take();
    ASSERT_GE(truth.height_m, scenario.scenario.trajectory.initial.height_m);
  }
  EXPECT_EQ(truth.header.sequence_number + 1, source.taken());
  EXPECT_LT(truth.height_m, 20.0 + 50.0 * kStep_s + 0.01);
  EXPECT_NEAR(truth.v_n.norm(), 100.0, 0.1);
  EXPECT_NEAR(truth.v_n.z(), 50.0, 0.1);
}

TEST(Catalogue, AircraftHoldsItsHeightThroughCoordinatedTurnsAndFeelsNoSideForce) {
  const scenario::Scenario scenario = catalogue_scenario("aircraft");
  auto model = model_of(scenario.trajectory);
  int turning = 0;
  double lowest_m = 1e9, highest_m = 0.0;
  for (int i = 0; i < 240000; ++i) {
    const TruthState truth = model.advance();
    const std::string& name = scenario.trajectory.segments.at(std::min<std::size_t>(truth.segment_index, 35)).name;
    if (name != "right turn" && name != "left turn") continue;
    ++turning;
    lowest_m = std::min(lowest_m, truth.height_m);
    highest_m = std::max(highest_m, truth.height_m);
    ASSERT_LT(std::abs(truth.f_v.y()), 0.05) << i;
    ASSERT_LT(truth.f_v.z(), -10.3) << i;
  }
  EXPECT_EQ(turning, 4 * 80 * 200);
  EXPECT_LT(highest_m - lowest_m, 10.0);
}

TEST(Catalogue, ShipHeavesAndSwaysAboutItsCourse) {
  auto model = model_of(catalogue_scenario("ship").trajectory);
  const double start_m = model.current().height_m;
  double roll = 0.0, heave_m = 0.0;
  for (int i = 0; i < 240000; ++i) {
    const TruthState truth = model.advance();
    const nav::RollPitchYaw rpy = nav::rpy_from_quaternion(truth.q_nv);
    roll = std::max(roll, std::abs(rpy.roll_rad));
    heave_m = std::max(heave_m, std::abs(truth.height_m - start_m));
    ASSERT_NEAR(truth.v_n.norm(), 6.0, 0.3) << i;
  }
  EXPECT_NEAR(roll, 0.133, 0.02);  // 6 deg/s * 8 s/(2 pi) = 7.64 deg
  EXPECT_LT(heave_m, 5.0);
}

class OfCatalogue : public testing::TestWithParam<std::string> {};

TEST_P(OfCatalogue, StateRateAndForceAreContinuousAtEveryJoint) {
  const scenario::Scenario scenario = catalogue_scenario(GetParam());
  const JointJumps jumps = jumps_at_joints(scenario.trajectory, scenario.duration_s);
  EXPECT_EQ(jumps.joints, scenario.trajectory.segments.size() - 1);
  // The limits of `inslab verify trajectory`, whose derivation stands there.
  EXPECT_LE(jumps.position_m, 3e-8);
  EXPECT_LE(jumps.velocity_m_per_s, 1e-10);
  EXPECT_LE(jumps.attitude_deg, 1e-10);
  EXPECT_LE(jumps.rate_deg_per_s, 1e-9);
  EXPECT_LE(jumps.specific_force_m_per_s2, 1e-9);
}

/// Five samples around an instant, and whether a corner or joint of the motion lies between them.
using Five = std::array<TruthState, 5>;

template <class Value>
Vector3 derivative(const Five& five, Value value) {
  return (value(five[0]) - 8.0 * value(five[1]) + 8.0 * value(five[3]) - value(five[4])) / (12.0 * kStep_s);
}

/// Where a derivative of the motion may jump, from the table alone.
std::vector<time::Nanoseconds> breaks_of(const scenario::Trajectory& trajectory) {
  std::vector<time::Nanoseconds> breaks;
  time::Nanoseconds start{0};
  for (const scenario::Segment& segment : trajectory.segments) {
    const trajectory::MotionSegment motion(segment, Vector3::Zero());
    for (const time::Nanoseconds joint : motion.joints()) breaks.push_back(start + joint);
    start += motion.duration();
  }
  return breaks;
}

TEST_P(OfCatalogue, VelocityAccelerationAndRateAreTheDerivativesOfPositionVelocityAndAttitude) {
  const scenario::Scenario scenario = catalogue_scenario(GetParam());
  const nav::Gravity gravity;
  auto model = model_of(scenario.trajectory);
  const std::vector<time::Nanoseconds> breaks = breaks_of(scenario.trajectory);
  const time::Nanoseconds step = std::chrono::milliseconds(5);
  const time::Nanoseconds end = std::min(time::from_seconds(scenario.duration_s), model.end());
  Five five;
  five[4] = model.current();
  int checked = 0;
  for (time::Nanoseconds now = step; now <= end; now += step) {
    std::rotate(five.begin(), five.begin() + 1, five.end());
    five[4] = model.advance();
    const auto next_break = std::upper_bound(breaks.begin(), breaks.end(), now - 4 * step);
    if (now < 4 * step || (next_break != breaks.end() && *next_break < now)) continue;
    ++checked;
    const TruthState& here = five[2];
    // Truncation is (5 ms)^4/30 = 2e-11 of the fifth derivative: of position at most 0.9 m/s^2 * pi^3 = 27 m/s^5 (bumps
    // of 0.5 deg/s and 2 s at 100 m/s); rounding is 1.5/5 ms of 1.4e-9 m.
    const Vector3 v =
        derivative(five, [&](const TruthState& t) { return nav::ned_from(geodetic_of(here), geodetic_of(t)); });
    ASSERT_LT((v - here.v_n).norm(), 1e-6) << now.count();
    // 2e-11 of 0.9 m/s^2 * pi^4, and 300/s of the rounding of 100 m/s.
    const Vector3 omega_en_n = nav::omega_en_n(geodetic_of(here), here.v_n);
    const Vector3 omega_ie_n = nav::omega_ie_n(here.latitude_rad);
    const Vector3 a_n =
        here.q_nv * here.f_v + gravity.g_n(geodetic_of(here)) - (2.0 * omega_ie_n + omega_en_n).cross(here.v_n);
    ASSERT_LT((derivative(five, [](const TruthState& t) { return t.v_n; }) - a_n).norm(), 1e-8) << now.count();
    // 2e-11 of 3 deg/s (2 pi/2.5 s)^4, and 300/s of the rounding of a quaternion.
    const Vector3 omega_nv_v = here.omega_iv_v - here.q_nv.conjugate() * (omega_ie_n + omega_en_n);
    const Vector3 turn = derivative(five, [&](const TruthState& t) {
      return nav::rotation_vector_from_quaternion(here.q_nv.conjugate() * t.q_nv);
    });
    ASSERT_LT((turn - omega_nv_v).norm(), 1e-9) << now.count();
  }
  EXPECT_GT(checked, 0.9 * static_cast<double>(end / step));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, OfCatalogue, testing::ValuesIn(catalogue()),
                         [](const auto& name) { return name.param; });

}  // namespace catalogue_test
}  // namespace inslab::verify
