#include <gtest/gtest.h>

#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/town_drive.hpp"

namespace inslab::verify {
namespace verify_navigation_test {

TEST(VerifyNavigation, FiltersThatMatchTheirImusKnowHowWrongTheyAreAfterAnOutageToo) {
  const Table table = honesty_table(100);
  EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(VerifyNavigation, WithEachOtherSensorTheyKnowItToo) {
  for (const Aid aid : kAids) {
    const Table table = honesty_table(100, aid);
    EXPECT_TRUE(table.held()) << to_text(table);
  }
}

TEST(VerifyNavigation, EachOtherSensorTakesAwayTheDriftThatItCan) {
  const Table table = aids_table({});
  EXPECT_EQ(table.rows.size(), 12U);
  EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(VerifyNavigation, DriftsOfARecordedDriveAreWithinTwiceTheThesisButForTheKnownMisses) {
  OutageRuns runs;
  runs.motions = {MotionFrom::File};
  const Table table = outage_table(runs);
  EXPECT_TRUE(table.held()) << to_text(table);
}

std::vector<double> lengths(const scenario::Trajectory& drive) {
  std::vector<double> lengths;
  for (const scenario::Segment& segment : drive.segments) lengths.push_back(segment.duration_s);
  return lengths;
}

TEST(VerifyNavigation, ASeedDrawsItsOwnDrive) {
  EXPECT_EQ(lengths(town_drive(1, 300.0, 1200.0)), lengths(town_drive(1, 300.0, 1200.0)));
  EXPECT_NE(lengths(town_drive(1, 300.0, 1200.0)), lengths(town_drive(2, 300.0, 1200.0)));
}

TEST(VerifyNavigation, ARecordedDriveIsTheDriveUpToTheRecordersErrors) {
  const auto file = recorded_drive(1, 10.0, 60.0);
  ASSERT_EQ(file->rows.size(), 12001U);
  // The recorder stands until the tenth second: fixes of 0.03 m at 1 Hz hold it there, to 5 sigma of a single one.
  const nav::Vector3 moved_m = nav::ned_from(file->rows.front().position, file->rows[1900].position);
  EXPECT_LT(moved_m.cwiseAbs().maxCoeff(), 0.15);
  EXPECT_GT(nav::ned_from(file->rows.front().position, file->rows.back().position).norm(), 100.0);
}

}  // namespace verify_navigation_test
}  // namespace inslab::verify
