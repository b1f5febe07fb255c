#include "inslab/formats/trajectory/trajectory_judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/foundation/units/units.hpp"

/// A vehicle that drives north at 10 m/s, row by row, with something wrong with it.
namespace inslab::trajectory {
namespace trajectory_judge_test {

using ::testing::IsEmpty;
using ::testing::Lt;

TrajectoryReading straight(double dt_s = 0.1, std::size_t rows = 101) {
  TrajectoryReading reading;
  const nav::Geodetic start{0.5, 1.0, 100.0};
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * dt_s;
    TrajectoryRow row;
    row.time = time::from_seconds(t);
    row.position = start;
    row.position.latitude_rad += 10.0 * t / 6'350'000.0;
    row.rpy = nav::RollPitchYaw{};
    reading.file.rows.push_back(row);
    reading.lines.push_back(k + 2);
  }
  for (std::size_t k = 0; k < rows; ++k) {
    const std::size_t from = k == 0 ? 0 : k - 1;
    const std::size_t to = k == 0 ? 1 : k;
    reading.file.rows[k].v_n = nav::ned_from(reading.file.rows[from].position, reading.file.rows[to].position) / dt_s;
  }
  return reading;
}

std::vector<std::string> rules_of(const TrajectoryReading& reading) {
  std::vector<std::string> rules;
  for (const auto& [rule, count] : reading.problems.counts()) {
    rules.push_back(std::string(enum_name(rule)) + " " + std::to_string(count));
  }
  return rules;
}

std::vector<std::string> judged(TrajectoryReading reading, const TrajectoryLimits& limits = {}) {
  judge_trajectory(reading, limits, false);
  return rules_of(reading);
}

TEST(TrajectoryJudge, HasNothingAgainstAGoodTrajectory) {
  TrajectoryReading reading = straight();
  const TrajectoryFigures figures = judge_trajectory(reading, TrajectoryLimits{}, false);
  EXPECT_THAT(rules_of(reading), IsEmpty());
  EXPECT_NEAR(figures.longest_interval_s.value, 0.1, 1e-9);
  EXPECT_THAT(figures.velocity_mismatch_m_per_s.value, Lt(1e-3));
  EXPECT_THAT(figures.position_step_m.value, Lt(1e-4));
  EXPECT_THAT(figures.off_track_deg.value, Lt(1e-3));
}

TEST(TrajectoryJudge, FindsAGap) {
  TrajectoryReading reading = straight();
  reading.file.rows.erase(reading.file.rows.begin() + 50, reading.file.rows.begin() + 80);
  EXPECT_EQ(judged(reading), std::vector<std::string>{"file_gap 1"});
}

TEST(TrajectoryJudge, FindsAVelocityThatContradictsThePositionsOnceForEachTime) {
  TrajectoryReading reading = straight();
  for (auto& row : reading.file.rows) row.v_n->z() = 0.6;
  EXPECT_EQ(judged(reading), std::vector<std::string>{"file_velocity 1"});
  for (auto& row : reading.file.rows) row.v_n->z() = 0.4;
  EXPECT_THAT(judged(reading), IsEmpty());
}

TEST(TrajectoryJudge, DoesNotTakeTheRoundingOfPositionsForAContradiction) {
  // Heights with 0.1 mm and rows 0.5 ms apart: 0.2 m/s from one row to the next.
  TrajectoryReading reading = straight(0.0005, 4001);
  for (std::size_t k = 1; k < reading.file.rows.size(); k += 2) reading.file.rows[k].position.height_m += 1e-4;
  const TrajectoryFigures figures = judge_trajectory(reading, TrajectoryLimits{}, false);
  EXPECT_THAT(rules_of(reading), IsEmpty());
  EXPECT_THAT(figures.velocity_mismatch_m_per_s.value, Lt(1e-3));
}

TEST(TrajectoryJudge, KeepsTheWindowTrueOverManyRows) {
  // More rows than the window's memory holds before it is cleared; the contradiction stands at their end.
  TrajectoryReading reading = straight(0.001, 12001);
  for (std::size_t k = 11000; k < 12001; ++k) reading.file.rows[k].v_n->y() += 0.55;
  TrajectoryLimits limits;
  limits.max_acceleration_m_per_s2 = 1e6;
  EXPECT_EQ(judged(reading, limits), std::vector<std::string>{"file_velocity 1"});
  EXPECT_THAT(judged(straight(0.001, 12001), limits), IsEmpty());
}

TEST(TrajectoryJudge, FindsAPositionThatIsReset) {
  TrajectoryReading reading = straight();
  for (std::size_t k = 50; k < 101; ++k) reading.file.rows[k].position.height_m += 0.4;
  EXPECT_EQ(judged(reading), std::vector<std::string>{"file_step 1"});
}

TEST(TrajectoryJudge, FindsAVelocityThatJumps) {
  TrajectoryReading reading = straight();
  reading.file.rows[50].v_n->z() = 20.0;
  TrajectoryLimits limits;
  limits.max_position_step_m = 10.0;
  limits.max_velocity_mismatch_m_per_s = 10.0;
  EXPECT_EQ(judged(reading, limits), std::vector<std::string>{"file_step 2"});  // there and back
}

TEST(TrajectoryJudge, FindsAnAttitudeThatIsReset) {
  TrajectoryReading reading = straight();
  for (std::size_t k = 0; k < 50; ++k) reading.file.rows[k].rpy->pitch_rad = 58.0 * units::kDeg;
  EXPECT_EQ(judged(reading), std::vector<std::string>{"file_step 1"});
}

TEST(TrajectoryJudge, TurnsThroughNorthWithoutAJump) {
  TrajectoryReading reading = straight();
  for (std::size_t k = 0; k < 101; ++k) {
    reading.file.rows[k].rpy->yaw_rad = (k % 2 == 0 ? 359.5 : 0.5) * units::kDeg;
  }
  EXPECT_THAT(judged(reading), IsEmpty());
}

TEST(TrajectoryJudge, HoldsTheNoseAgainstTheTrackWhenAskedTo) {
  TrajectoryReading reading = straight();
  for (auto& row : reading.file.rows) row.rpy->yaw_rad = 40.0 * units::kDeg;
  EXPECT_THAT(judged(reading), IsEmpty());
  TrajectoryLimits limits;
  limits.max_off_track_deg = 30.0;
  EXPECT_EQ(judged(reading, limits), std::vector<std::string>{"file_off_track 100"});
}

TEST(TrajectoryJudge, JudgesPositionsAloneByTheAccelerationTheyMean) {
  TrajectoryReading reading = straight();
  for (auto& row : reading.file.rows) row.v_n.reset();
  EXPECT_THAT(judged(reading), IsEmpty());
  for (std::size_t k = 50; k < 101; ++k) reading.file.rows[k].position.height_m += 2.0;
  EXPECT_EQ(judged(reading), std::vector<std::string>{"file_step 2"});  // into the jump and out of it
}

/// 15 m/s up a grade of 2 % at 10 Hz: the motion has no acceleration, all of it is the heights' rounding.
TrajectoryFigures figures_with_heights_of(int decimals) {
  TrajectoryReading reading;
  const double step_m = std::pow(10.0, -decimals);
  for (std::size_t k = 0; k < 601; ++k) {
    const double t = 0.1 * static_cast<double>(k);
    TrajectoryRow row;
    row.time = time::from_seconds(t);
    row.position = {0.8 + 15.0 * t / 6'380'000.0, 0.2, std::round((500.0 + 0.3 * t) / step_m) * step_m};
    reading.file.rows.push_back(row);
    reading.lines.push_back(k + 2);
  }
  reading.step_ned_m = {0.0, 0.0, step_m};
  return judge_trajectory(reading, TrajectoryLimits{}, false);
}

TEST(TrajectoryJudge, JudgesTheCurveAndNotTheRows) {
  // From row to row the heights' second difference is 0.1 m / (0.1 s)^2 = 10 m/s^2. Where it is 10 and then -10, the
  // spline makes 10 6/(2 sqrt(3)) (1 + 2 - sqrt(3)) = 22 m/s^2 of it, and a little less with the next ones near.
  const double largest = figures_with_heights_of(1).acceleration_m_per_s2.value;
  EXPECT_GT(largest, 20.0);
  EXPECT_LT(largest, 22.1);
}

TEST(TrajectoryJudge, SaysThatTheRoundingIsMoreThanTheMotion) {
  const nav::Vector3 coarse = figures_with_heights_of(1).rounding_m_per_s2;
  EXPECT_EQ(coarse.x(), 0.0);
  EXPECT_EQ(coarse.y(), 0.0);
  EXPECT_NEAR(coarse.z(), 20.0, 1e-9);                                    // 2 0.1 m / (0.1 s)^2
  EXPECT_TRUE(figures_with_heights_of(4).rounding_m_per_s2.isZero(0.0));  // 0.02 m/s^2
  // One decimal of which nothing is seen: the vehicle stays at its height.
  TrajectoryReading level = straight();
  for (auto& row : level.file.rows) row.v_n.reset();
  level.step_ned_m = {0.0, 0.0, 0.1};
  EXPECT_TRUE(judge_trajectory(level, TrajectoryLimits{}, false).rounding_m_per_s2.isZero(0.0));
}

}  // namespace trajectory_judge_test
}  // namespace inslab::trajectory
