// What `inslab verify` shows, in short: the command takes whole runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "services/inslab/verify/deviation.hpp"
#include "services/inslab/verify/increments.hpp"
#include "tests/unit/inslab/rows_held.hpp"

namespace inslab::verify {
namespace {

TEST(VerifyIncrements, ErrorsFallAsTheOrderOfTheAlgorithmSays) {
  // Half a minute: the errors at 1000 Hz are then beyond the 2 nm to which latitude and longitude are published.
  for (const Table& table : increments(30.0)) EXPECT_TRUE(every_row_held(table));
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

}  // namespace
}  // namespace inslab::verify
