#include "time/rate.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace inslab::time {
namespace {

TEST(Rate, GridDoesNotDriftInADay) { EXPECT_EQ(Rate(200.0).at(200ull * 86'400), std::chrono::hours(24)); }

TEST(Rate, CountsPeriodsOfTheFasterRate) {
  EXPECT_EQ(Rate(5.0).multiple_of(Rate(200.0)), 40u);
  EXPECT_EQ(Rate(200.0).multiple_of(Rate(200.0)), 1u);
}

TEST(Rate, RefusesAPeriodThatIsNotAMultiple) {
  EXPECT_THROW(Rate(80.0).multiple_of(Rate(200.0)), std::invalid_argument);
  EXPECT_THROW(Rate(400.0).multiple_of(Rate(200.0)), std::invalid_argument);
}

TEST(Rate, RefusesAPeriodThatIsNoWholeNumberOfNanoseconds) {
  EXPECT_THROW(Rate(3.0), std::invalid_argument);
  EXPECT_THROW(Rate(300.0), std::invalid_argument);
}

TEST(Rate, RefusesZeroNegativeAndNan) {
  EXPECT_THROW(Rate(0.0), std::invalid_argument);
  EXPECT_THROW(Rate(-1.0), std::invalid_argument);
  EXPECT_THROW(Rate(0.0 / 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace inslab::time
