#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace trajectory_rules_test {

using tables::at_wuhan;
using tables::constant_rate;
using tables::delta_speed;
using tables::motion;
using tables::segment;
using tables::target_speed;

struct NamesOfFields {
  std::set<std::string> names;
  template <class T>
  void operator()(const Field& field, T&) {
    names.insert(std::string(field.name));
  }
};

std::set<std::string> fields_of(scenario::MotionType type) {
  scenario::Motion m = motion(type);
  NamesOfFields visitor;
  scenario::Motion::fields(m, visitor);
  return visitor.names;
}

TEST(MotionFields, AreThoseOfTheTypeAlone) {
  using Names = std::set<std::string>;
  EXPECT_EQ(fields_of(scenario::MotionType::Uniform), (Names{"type"}));
  EXPECT_EQ(fields_of(scenario::MotionType::TargetSpeed),
            (Names{"type", "axis", "final_speed_m_per_s", "ramp_fraction"}));
  EXPECT_EQ(fields_of(scenario::MotionType::SineAccel), (Names{"type", "axis", "amplitude_m_per_s2", "period_s"}));
  EXPECT_EQ(fields_of(scenario::MotionType::CosineRate), (Names{"type", "axis", "amplitude_deg_per_s", "period_s"}));
  EXPECT_EQ(fields_of(scenario::MotionType::Turn), (Names{"type", "axis", "angle_deg", "ramp_fraction"}));
}

TEST(MotionFields, NameEveryType) {
  EXPECT_EQ(enum_name(scenario::MotionType::RampRate), "ramp_rate");
  EXPECT_EQ(enum_name(scenario::MotionType::Turn), "turn");
  EXPECT_EQ(enum_name(scenario::MotionType::CosineRate), "cosine_rate");
}

TEST(MotionAxis, IsForwardForSpeedsAndDownForTurnsUnlessNamed) {
  EXPECT_EQ(scenario::axis_of(delta_speed(1.0)), scenario::Axis::X);
  EXPECT_EQ(scenario::axis_of(motion(scenario::MotionType::Turn)), scenario::Axis::Z);
  scenario::Motion heave = motion(scenario::MotionType::SineAccel);
  heave.axis = scenario::Axis::Z;
  EXPECT_EQ(scenario::axis_of(heave), scenario::Axis::Z);
}

TEST(TrajectoryRules, AcceptAPlainTable) {
  scenario::Trajectory t = at_wuhan();
  t.segments = {segment(10.0), segment(5.0, {target_speed(10.0), constant_rate(5.0)})};
  EXPECT_FALSE(scenario::violation(t).has_value());
}

TEST(TrajectoryRules, RefuseASecondAccelerationBesideATargetSpeed) {
  scenario::Trajectory t = at_wuhan();
  t.segments = {segment(10.0), segment(5.0, {target_speed(10.0), delta_speed(1.0)})};
  ASSERT_TRUE(scenario::violation(t).has_value());
  EXPECT_EQ(scenario::violation(t)->path, "segments[1].motions[1].axis");
}

TEST(TrajectoryRules, RefuseATargetSpeedAlongAnAxisThatTurnsAwayFromTheVelocity) {
  scenario::Trajectory t = at_wuhan();
  t.segments = {segment(5.0, {constant_rate(5.0), target_speed(10.0)})};
  t.segments[0].keep_velocity_on_nose = false;
  ASSERT_TRUE(scenario::violation(t).has_value());
  EXPECT_EQ(scenario::violation(t)->path, "segments[0].motions[0].type");
}

TEST(TrajectoryRules, RefuseMoreThanABillionSeconds) {
  scenario::Trajectory t = at_wuhan();
  t.segments.assign(101, segment(1e7));
  ASSERT_TRUE(scenario::violation(t).has_value());
  EXPECT_EQ(scenario::violation(t)->path, "segments[100].duration_s");
}

}  // namespace trajectory_rules_test
}  // namespace inslab::trajectory
