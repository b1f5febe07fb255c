#include "inslab/models/gnss/outage_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"

namespace inslab::gnss {
namespace outage_schedule_test {

using units::kDeg;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
const nav::Geodetic kAnywhere{0.5, 2.0, 0.0};

TEST(OutageSchedule, HoldsFromItsStartToBeforeItsEnd) {
  const OutageSchedule schedule({{10.0, 2.0, 0.0}}, {});
  EXPECT_FALSE(schedule.covers(10 * kSecond_ns - 1, kAnywhere));
  EXPECT_TRUE(schedule.covers(10 * kSecond_ns, kAnywhere));
  EXPECT_TRUE(schedule.covers(12 * kSecond_ns - 1, kAnywhere));
  EXPECT_FALSE(schedule.covers(12 * kSecond_ns, kAnywhere));
}

TEST(OutageSchedule, ComesAgainEveryPeriodUntilTheEnd) {
  const OutageSchedule schedule({{10.0, 2.0, 60.0}}, {});
  for (const std::int64_t n : {0LL, 1LL, 2LL, 1000LL}) {
    const std::int64_t start_ns = (10 + 60 * n) * kSecond_ns;
    EXPECT_FALSE(schedule.covers(start_ns - 1, kAnywhere)) << n;
    EXPECT_TRUE(schedule.covers(start_ns, kAnywhere)) << n;
    EXPECT_TRUE(schedule.covers(start_ns + 2 * kSecond_ns - 1, kAnywhere)) << n;
    EXPECT_FALSE(schedule.covers(start_ns + 2 * kSecond_ns, kAnywhere)) << n;
  }
  EXPECT_FALSE(schedule.covers(0, kAnywhere));
}

/// A tunnel of two legs across the antimeridian, 10 m to each side.
OutageSchedule tunnel() {
  return OutageSchedule({}, {{"tunnel", 10.0, {{-30.0, 179.98}, {-30.0, -179.98}, {-29.97, -179.98}}}});
}

nav::Geodetic beside(double latitude_deg, double longitude_deg, double north_m, double east_m, double height_m = 0.0) {
  nav::Geodetic place = nav::displaced({latitude_deg * kDeg, longitude_deg * kDeg, 0.0}, {north_m, east_m, 0.0});
  place.height_m += height_m;
  return place;
}

TEST(OutageSchedule, CoversATunnelToItsWallsAtAnyHeight) {
  const OutageSchedule schedule = tunnel();
  // A straight leg of L = 3.9 km along a parallel runs L^2 tan(30 deg)/(8 R) = 0.17 m nearer the pole in its middle;
  // that it lies 0.3 m deep there adds 5 mm to the distance.
  EXPECT_TRUE(schedule.covers(0, beside(-30.0, 180.0, 9.6, 0.0)));
  EXPECT_FALSE(schedule.covers(0, beside(-30.0, 180.0, 10.4, 0.0)));
  EXPECT_TRUE(schedule.covers(0, beside(-30.0, 180.0, -9.6, 0.0, 8000.0)));
  EXPECT_TRUE(schedule.covers(0, beside(-29.985, -179.98, 0.0, 9.9)));
  EXPECT_FALSE(schedule.covers(0, beside(-29.985, -179.98, 0.0, 10.1)));
}

TEST(OutageSchedule, RoundsTheEndsOfATunnel) {
  const OutageSchedule schedule = tunnel();
  EXPECT_TRUE(schedule.covers(0, beside(-30.0, 179.98, 0.0, -9.9)));
  EXPECT_FALSE(schedule.covers(0, beside(-30.0, 179.98, 0.0, -10.1)));
  EXPECT_FALSE(schedule.covers(0, beside(-30.0, 179.98, 8.0, -8.0)));
}

TEST(OutageSchedule, CoversACircleRoundAPointAndNotItsAntipode) {
  const OutageSchedule schedule({}, {{"hall", 100.0, {{48.0, 11.0}}}});
  EXPECT_TRUE(schedule.covers(0, beside(48.0, 11.0, 60.0, -79.0)));
  EXPECT_FALSE(schedule.covers(0, beside(48.0, 11.0, 61.0, -81.0)));
  EXPECT_FALSE(schedule.covers(0, {-48.0 * kDeg, -169.0 * kDeg, 0.0}));
}

TEST(OutageSchedule, RefusesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(OutageSchedule({{1.0, -1.0, 0.0}}, {}), std::invalid_argument);
  EXPECT_THROW(OutageSchedule({{nan, 1.0, 0.0}}, {}), std::invalid_argument);
  EXPECT_THROW(OutageSchedule({{1.0, 2.0, 2.0}}, {}), std::invalid_argument);
  EXPECT_THROW(OutageSchedule({}, {{"nowhere", 10.0, {}}}), std::invalid_argument);
}

}  // namespace outage_schedule_test
}  // namespace inslab::gnss
