#include "inslab/formats/trajectory/trajectory_repair.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

/// A car that stands for two seconds and then drives north, recorded at 10 Hz, with something wrong with it.
namespace inslab::trajectory {
namespace trajectory_repair_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::size_t kRows = 121;
constexpr double kInterval_s = 0.1;

TrajectoryReading drive() {
  TrajectoryReading reading;
  reading.columns = columns_of_plain_text(11).value();
  const nav::Geodetic start{0.5, 1.0, 100.0};
  for (std::size_t k = 0; k < kRows; ++k) {
    const double t = kInterval_s * static_cast<double>(k);
    const double driven_s = std::max(0.0, t - 2.0);
    TrajectoryRow row;
    row.time = time::from_seconds(t);
    row.position = nav::displaced(start, {driven_s * driven_s, 0.0, 0.0});  // 2 m/s^2
    row.v_n = nav::Vector3(2.0 * driven_s, 0.0, 0.0);
    row.rpy = nav::RollPitchYaw{};
    reading.file.rows.push_back(row);
    reading.lines.push_back(k + 2);
  }
  return reading;
}

struct Outcome {
  TrajectoryReading reading;
  std::vector<RepairNote> notes;
};

Outcome repair(const TrajectoryReading& reading) {
  Outcome outcome;
  outcome.reading = repaired(reading, TrajectoryLimits{}, RepairBounds{}, outcome.notes);
  return outcome;
}

bool is_good(TrajectoryReading reading) {
  judge_trajectory(reading, TrajectoryLimits{}, false);
  return reading.problems.empty();
}

TEST(TrajectoryRepair, ChangesNothingOfAGoodFile) {
  const TrajectoryReading before = drive();
  const Outcome outcome = repair(before);
  EXPECT_THAT(outcome.notes, SizeIs(0));
  ASSERT_EQ(outcome.reading.file.rows.size(), kRows);
  for (std::size_t k = 0; k < kRows; ++k) {
    EXPECT_EQ(outcome.reading.file.rows[k].position.latitude_rad, before.file.rows[k].position.latitude_rad);
    EXPECT_EQ(*outcome.reading.file.rows[k].v_n, *before.file.rows[k].v_n);
  }
}

TEST(TrajectoryRepair, ReplacesTheAttitudeOfAStandingVehicleBeforeALargeReset) {
  TrajectoryReading reading = drive();
  for (std::size_t k = 0; k < 15; ++k) reading.file.rows[k].rpy->pitch_rad = 58.0 * units::kDeg;
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_TRUE(outcome.notes[0].is_repaired);
  EXPECT_EQ(outcome.notes[0].text,
            "lines 2 to 16: the attitude before a reset of 58 deg was replaced by the one after it; the vehicle stood "
            "(at most 0 m/s)");
  EXPECT_TRUE(is_good(outcome.reading));
  EXPECT_EQ(outcome.reading.file.rows[0].rpy->pitch_rad, 0.0);
}

TEST(TrajectoryRepair, LeavesALargeResetOfAMovingVehicleAndSaysSo) {
  TrajectoryReading reading = drive();
  for (std::size_t k = 0; k < 60; ++k) reading.file.rows[k].rpy->pitch_rad = 58.0 * units::kDeg;
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_FALSE(outcome.notes[0].is_repaired);
  EXPECT_EQ(outcome.notes[0].text, "line 62: an attitude reset of 58 deg of a moving vehicle was left");
  EXPECT_FALSE(is_good(outcome.reading));
}

TEST(TrajectoryRepair, SpreadsAPositionStepOverTheTimeBeforeItAndKeepsWhatComesAfter) {
  TrajectoryReading reading = drive();
  const TrajectoryReading truth = drive();
  for (std::size_t k = 0; k < 60; ++k) {
    reading.file.rows[k].position = nav::displaced(reading.file.rows[k].position, {0.0, -0.9, 0.0});
  }
  EXPECT_FALSE(is_good(reading));
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_THAT(outcome.notes[0].text, HasSubstr("lines 2 to 61: a position step of 0.9 m was spread over them (6 s)"));
  EXPECT_TRUE(is_good(outcome.reading));
  for (std::size_t k = 60; k < kRows; ++k) {
    EXPECT_EQ(outcome.reading.file.rows[k].position.longitude_rad, truth.file.rows[k].position.longitude_rad);
  }
  // The slope of a cosine's half over 6 s is at most pi/2 of 0.9 m / 6 s.
  for (const TrajectoryRow& row : outcome.reading.file.rows) EXPECT_LE(std::abs(row.v_n->y()), 0.2357);
}

TEST(TrajectoryRepair, DerivesVelocitiesThatContradictThePositions) {
  TrajectoryReading reading = drive();
  for (std::size_t k = 0; k < kRows; ++k) reading.file.rows[k].v_n->z() = k < 60 ? 0.0 : 0.8;
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_THAT(outcome.notes[0].text, HasSubstr("were derived from the positions; the largest change was 0.8"));
  EXPECT_TRUE(is_good(outcome.reading));
}

TEST(TrajectoryRepair, BridgesAGapAlongTheCubic) {
  TrajectoryReading reading = drive();
  const TrajectoryReading truth = drive();
  reading.file.rows.erase(reading.file.rows.begin() + 50, reading.file.rows.begin() + 80);
  reading.lines.erase(reading.lines.begin() + 50, reading.lines.begin() + 80);
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_EQ(outcome.notes[0].text, "lines 51 to 82: a gap of 3.1 s was filled with 30 rows");
  ASSERT_EQ(outcome.reading.file.rows.size(), kRows);
  EXPECT_TRUE(is_good(outcome.reading));
  // Constant acceleration is a quadratic, which the cubic holds exactly, but for the curvature of the Earth: NED turns
  // by d/R over d = 40 m, 6e-6 rad of a chord of 40 m.
  for (std::size_t k = 0; k < kRows; ++k) {
    const TrajectoryRow& row = outcome.reading.file.rows[k];
    EXPECT_EQ(row.time, truth.file.rows[k].time);
    EXPECT_LE(nav::ned_from(truth.file.rows[k].position, row.position).norm(), 40.0 * 6e-6);
    EXPECT_LE((*row.v_n - *truth.file.rows[k].v_n).norm(), 20.0 * 6e-6);
  }
}

TEST(TrajectoryRepair, LeavesAGapThatNothingTellsHowToCross) {
  TrajectoryReading reading = drive();
  for (auto& row : reading.file.rows) row.v_n.reset();
  reading.file.rows.erase(reading.file.rows.begin() + 50, reading.file.rows.begin() + 80);
  reading.lines.erase(reading.lines.begin() + 50, reading.lines.begin() + 80);
  const Outcome outcome = repair(reading);
  ASSERT_THAT(outcome.notes, SizeIs(1));
  EXPECT_FALSE(outcome.notes[0].is_repaired);
}

}  // namespace trajectory_repair_test
}  // namespace inslab::trajectory
