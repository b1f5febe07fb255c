// What `inslab verify` shows, in short: the command takes whole runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "inslab/data/json/config_error.hpp"
#include "inslab/referee/verify/closed_loop_block.hpp"
#include "inslab/referee/verify/deviation.hpp"
#include "inslab/referee/verify/increments_block.hpp"
#include "inslab/referee/verify/spline_loop.hpp"
#include "tests/unit/models/trajectory/tables.hpp"
#include "tests/unit/referee/verify/rows_held.hpp"

namespace inslab::verify {
namespace verify_test {

TEST(VerifyIncrements, ErrorsFallAsTheOrderOfTheAlgorithmSays) {
  // Half a minute: the errors at 1000 Hz are then beyond the 2 nm to which latitude and longitude are published.
  for (const Table& table : increments(30.0)) EXPECT_TRUE(every_row_held(table));
}

LoopCase two_minutes_of(const char* name, const scenario::Trajectory& trajectory) {
  return {name, trajectory, 0.0, time::from_seconds(120.0)};
}

TEST(VerifyClosedLoop, SparseRowsBySplineAreMetAndMechanizeWithinAMillimetre) {
  namespace tables = trajectory::tables;
  const std::vector<LoopCase> cases{two_minutes_of("ship", trajectory::tables::ship()),
                                    two_minutes_of("aircraft", trajectory::tables::aircraft())};
  EXPECT_TRUE(every_row_held(spline_table("10 Hz", cases, time::Rate(10.0))));
  EXPECT_TRUE(every_row_held(spline_table("1 Hz", cases, time::Rate(1.0))));
}

/// A car's rows as a receiver would give them: 1 cm and 0.05 deg at random besides what contradictory_rows() does.
std::shared_ptr<const TrajectoryFile> noisy_rows() {
  auto file = std::make_shared<TrajectoryFile>(
      *contradictory_rows(two_minutes_of("noisy", trajectory::tables::basic()), time::from_seconds(120.0)));
  std::mt19937 engine(3);
  std::normal_distribution<double> place_m(0.0, 0.01), angle_rad(0.0, 9e-4);
  for (TrajectoryRow& row : file->rows) {
    row.position = nav::displaced(row.position, {place_m(engine), place_m(engine), place_m(engine)});
    row.rpy->yaw_rad += angle_rad(engine);
    row.rpy->roll_rad += angle_rad(engine);
  }
  return file;
}

TEST(VerifyClosedLoop, NoisyRowsBySplineStayWithinTheBoundOfTheirAccelerations) {
  EXPECT_TRUE(every_row_held(spline_file_table({noisy_rows()})));
}

/// The catalogue for its first two minutes; the projectile whole.
std::vector<LoopCase> shortened(std::vector<LoopCase> cases) {
  for (LoopCase& one : cases) one.duration = std::min<time::Nanoseconds>(one.duration, std::chrono::minutes(2));
  return cases;
}

TEST(VerifyClosedLoop, ComesBackToTheFilesOfTheCatalogue) {
  EXPECT_TRUE(every_row_held(inverse_mechanization_table("", shortened(loop_cases()))));
}

TEST(VerifyClosedLoop, LimitIsATenthOfThePublishedFigure) {
  const std::vector<LoopCase> cases = loop_cases();
  ASSERT_EQ(cases.size(), 6U);
  EXPECT_DOUBLE_EQ(position_limit_m(cases.at(1)), 0.00015);
  EXPECT_DOUBLE_EQ(position_limit_m(cases.at(5)), 3e-5);
}

TEST(VerifyClosedLoop, AnHourIsTheSegmentsThreeTimes) {
  const std::vector<LoopCase> cases = loop_cases(), hours = for_an_hour(cases);
  ASSERT_EQ(hours.size(), cases.size() - 1);
  EXPECT_EQ(hours.at(2).trajectory.segments.size(), 3 * cases.at(2).trajectory.segments.size());
  EXPECT_EQ(hours.at(2).duration, std::chrono::hours(1));
}

TEST(VerifyClosedLoop, StaysWithinTheBoundOfAFileThatContradictsItself) {
  EXPECT_TRUE(every_row_held(contradiction_table({contradictory_rows(loop_cases().at(2), std::chrono::minutes(2))})));
}

TEST(VerifyClosedLoop, StaysWithinTheBoundsOfRealFilesInBothModes) {
  const std::filesystem::path folder = std::string(INSLAB_SOURCE_DIR) + "/../shared/data/trajectories";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real trajectories in " << folder;
  const std::vector<std::shared_ptr<const TrajectoryFile>> files{
      real_rows(folder / "whu_kfginsmatlab_dataset2_truth.nav"),
      real_rows(folder / "novatel_propak6_20Hz_profile10.csv")};
  EXPECT_TRUE(every_row_held(contradiction_table(files)));
  EXPECT_TRUE(every_row_held(spline_file_table(files)));
}

TEST(VerifyClosedLoop, RefusesAFileWithoutAttitude) {
  EXPECT_THROW(real_rows(std::string(INSLAB_SOURCE_DIR) + "/config/invalid/method_needs.csv"), json::Error);
}

nav::NavState at_height(double height_m) { return {{0.5, 2.0, height_m}, nav::Vector3::Zero(), {1.0, 0.0, 0.0, 0.0}}; }

DeviationFigures of_heights(const std::vector<double>& heights_m) {
  Deviation deviation(heights_m.size());
  for (const double height_m : heights_m) deviation.add(at_height(height_m), at_height(0.0));
  return deviation.figures();
}

TEST(Deviation, GivesRootMeanSquareAndLargestOfAllAndOfTheThirds) {
  const DeviationFigures found = of_heights({3.0, 4.0, 0.0, 0.0, 1.0, -7.0});
  EXPECT_DOUBLE_EQ(found.position_rms_m, std::sqrt(75.0 / 6.0));
  EXPECT_DOUBLE_EQ(found.position_max_m, 7.0);
  EXPECT_DOUBLE_EQ(found.position_middle_third_rms_m, 0.0);
  EXPECT_DOUBLE_EQ(found.position_last_third_rms_m, 5.0);
}

TEST(Deviation, IsSettledUnlessTheLastThirdIsHalfAsLargeAgainAsTheMiddleOne) {
  EXPECT_TRUE(of_heights({0.0, 1.0, 1.49}).settled());
  EXPECT_FALSE(of_heights({0.0, 1.0, 1.51}).settled());
}

}  // namespace verify_test
}  // namespace inslab::verify
