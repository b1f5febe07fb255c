#include "inslab/sim/look_ahead.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace inslab::sim {
namespace look_ahead_test {

/// Ten seconds from 100 m/s at 50 m: 2 m/s^2 along, and a turn whose rate is 30 deg/s in its middle third or so.
scenario::LoadedScenario turning() {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.name = "turning";
  s.seed = 7;
  s.duration_s = 10.0;
  s.trajectory.initial.latitude_deg = 30.0;
  s.trajectory.initial.height_m = 50.0;
  s.trajectory.initial.speed_m_per_s = 100.0;
  scenario::Motion turn;
  turn.type = scenario::MotionType::ConstantRate;
  turn.rate_deg_per_s = 30.0;
  scenario::Motion speed_up;
  speed_up.type = scenario::MotionType::ConstantAccel;
  speed_up.acceleration_m_per_s2 = 2.0;
  s.trajectory.segments.push_back({"straight", 4.0, {}, true});
  s.trajectory.segments.push_back({"turn", 2.0, {turn}, true});
  s.trajectory.segments.push_back({"speed up", 4.0, {speed_up}, true});
  loaded.truth_samples = 2001;
  scenario::LoadedImu imu;
  imu.rate = time::Rate(200.0);
  imu.errors.name = "weak";
  loaded.imus.push_back(imu);
  return loaded;
}

TEST(LookAhead, FindsTheExtremesOfTheMotionAndTheirTimes) {
  const LookAhead ahead = look_ahead(turning(), 60.0);
  EXPECT_EQ(ahead.span_s, 10.0);
  EXPECT_NEAR(ahead.speed_m_per_s.value, 108.0, 1e-3);
  EXPECT_EQ(ahead.speed_m_per_s.at_s, 10.0);
  // 15 deg/h of the Earth are 0.004 deg/s.
  EXPECT_NEAR(ahead.rate_deg_per_s.value, 30.0, 5e-3);
  EXPECT_GE(ahead.rate_deg_per_s.at_s, 4.0);
  EXPECT_LE(ahead.rate_deg_per_s.at_s, 6.0);
  // 100 m/s at 30 deg/s press with 52.36 m/s^2 sideways, and g.
  EXPECT_NEAR(ahead.specific_force_m_per_s2.value, std::hypot(52.36, 9.79), 0.05);
  EXPECT_NEAR(ahead.lowest_m.value, 50.0, 0.1);
  EXPECT_TRUE(ahead.over_scale.empty());
  EXPECT_FALSE(ahead.filter.has_value()) << "there is no receiver";
}

TEST(LookAhead, WarnsBeyondTheFullScaleWithTimeAndValue) {
  scenario::LoadedScenario loaded = turning();
  loaded.imus[0].errors.gyro.full_scale_deg_per_s.setConstant(25.0);
  loaded.imus[0].errors.accel.full_scale_g.setConstant(5.0);
  const LookAhead ahead = look_ahead(loaded, 60.0);
  ASSERT_EQ(ahead.over_scale.size(), 2U);
  const OverScale& gyro = ahead.over_scale[0];
  EXPECT_TRUE(gyro.is_gyro);
  EXPECT_EQ(gyro.axis, 2);
  EXPECT_EQ(gyro.full_scale, 25.0);
  EXPECT_NEAR(gyro.largest.value, 30.0, 5e-3);
  EXPECT_NEAR(gyro.first_s, 4.005, 1e-9);
  EXPECT_EQ(gyro.samples, 400U);
  const OverScale& accel = ahead.over_scale[1];
  EXPECT_EQ(accel.axis, 1);
  EXPECT_NEAR(accel.largest.value, 52.36 / 9.80665, 1e-2);
  const std::string text = text_of(ahead);
  EXPECT_NE(text.find("warning: beyond the full scale of IMU 0's gyros, 25 deg/s: 30 deg/s about z at "),
            std::string::npos)
      << text;
}

TEST(LookAhead, TakesTheFullScaleOfTheProfileThatIsSwappedIn) {
  scenario::LoadedScenario loaded = turning();
  ImuErrorProfile weak = loaded.imus[0].errors;
  weak.gyro.full_scale_deg_per_s.setConstant(20.0);
  weak.request.request_id = 1;
  weak.request.apply_at_ns = 5'000'000'000;
  loaded.swaps.emplace_back(weak);
  const LookAhead ahead = look_ahead(loaded, 60.0);
  ASSERT_EQ(ahead.over_scale.size(), 1U);
  EXPECT_NEAR(ahead.over_scale[0].first_s, 5.005, 1e-9);
  EXPECT_EQ(ahead.over_scale[0].full_scale, 20.0);
}

TEST(LookAhead, RefusesAMotionThatLeavesTheDomainAndNamesTheLimits) {
  scenario::LoadedScenario loaded = turning();
  loaded.scenario.trajectory.initial.height_m = -990.0;
  loaded.scenario.trajectory.initial.pitch_deg = -10.0;
  try {
    look_ahead(loaded, 60.0);
    FAIL() << "was accepted";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("height"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("-1000"), std::string::npos) << error.what();
  }
}

TEST(LookAhead, SaysWhenTheReferenceFilterBeginsOrWhatToSet) {
  const auto shipped = [](const std::string& name) {
    return scenario::load(std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "scenarios" / (name + ".json"));
  };
  const LookAhead circle = look_ahead(shipped("circle"), 100.0);
  ASSERT_TRUE(circle.filter && circle.filter->begins_s) << circle.filter->why_not;
  EXPECT_NEAR(*circle.filter->begins_s, 60.0, 0.01);
  // The circle comes after the filter's beginning, which is when the look ahead leaves what it has no use for.
  EXPECT_EQ(circle.span_s, 100.0);
  EXPECT_GT(circle.rate_deg_per_s.at_s, 60.0);
  EXPECT_GT(circle.rate_deg_per_s.value, 1.0);
  scenario::LoadedScenario narrow = shipped("circle");
  narrow.imus[0].errors.gyro = {};
  narrow.imus[0].vibration = {};
  narrow.imus[0].vibration.target = narrow.imus[0].errors.target;
  narrow.imus[0].errors.gyro.full_scale_deg_per_s.setConstant(0.5 * circle.rate_deg_per_s.value);
  const LookAhead over = look_ahead(narrow, 100.0);
  EXPECT_NEAR(*over.filter->begins_s, 60.0, 0.01);
  ASSERT_EQ(over.over_scale.size(), 1U);
  EXPECT_GT(over.over_scale[0].first_s, 60.0);
  scenario::LoadedScenario still = shipped("static");
  still.imus[0].errors.gyro.bias_turn_on_sigma_deg_per_h.setConstant(500.0);
  const LookAhead lost = look_ahead(still, 70.0);
  ASSERT_TRUE(lost.filter.has_value());
  EXPECT_FALSE(lost.filter->begins_s.has_value());
  EXPECT_NE(lost.filter->why_not.find("heading unsure"), std::string::npos) << lost.filter->why_not;
  EXPECT_NE(lost.filter->why_not.find("velocity changed"), std::string::npos) << lost.filter->why_not;
  EXPECT_NE(text_of(lost).find("initial.attitude 'levelled' and the yaw, or 'given' and all three angles"),
            std::string::npos)
      << text_of(lost);
}

TEST(LookAhead, OffersALevelledBeginningOnlyToAVehicleThatRests) {
  scenario::LoadedScenario steady = turning();
  steady.scenario.trajectory.segments.clear();
  scenario::LoadedGnss receiver;
  receiver.rate = time::Rate(10.0);
  receiver.errors.target.kind = receiver.installation.target.kind = receiver.nominal_installation.target.kind =
      SensorKind::Gnss;
  receiver.errors.position_sigma_ned_m.setConstant(0.05);
  receiver.errors.velocity_sigma_ned_m_per_s.setConstant(0.05);
  steady.gnss.push_back(receiver);
  const LookAhead ahead = look_ahead(steady, 100.0);
  ASSERT_TRUE(ahead.filter.has_value());
  EXPECT_FALSE(ahead.filter->begins_s.has_value());
  EXPECT_NE(ahead.filter->why_not.find("the receiver says that it moves"), std::string::npos) << ahead.filter->why_not;
  const std::string said = text_of(ahead);
  EXPECT_EQ(said.find("levelled"), std::string::npos) << said;
  EXPECT_NE(said.find("initial.attitude 'given' and all three angles"), std::string::npos) << said;
}

}  // namespace look_ahead_test
}  // namespace inslab::sim
