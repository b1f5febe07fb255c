#include "inslab/foundation/time/gps_time.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace inslab::time {
namespace gps_time_test {

using std::chrono::seconds;

TEST(GpsTime, CarriesWeeksForward) {
  const GpsTime start{2345, 604'799'000'000'000};
  EXPECT_EQ(start + seconds(2), (GpsTime{2346, 1'000'000'000}));
}

TEST(GpsTime, CarriesWeeksBackward) {
  EXPECT_EQ((GpsTime{2345, 0} + seconds(-1)), (GpsTime{2344, 604'799'000'000'000}));
}

TEST(GpsTime, DifferenceUndoesSum) {
  const GpsTime start{2345, 345'600'000'000'000};
  const Nanoseconds elapsed(1'234'567'890'123'456);
  EXPECT_EQ((start + elapsed) - start, elapsed);
}

TEST(GpsTime, FromRealtimeAddsEighteenLeapSecondsToday) {
  // 2026-01-01T00:00:00Z is GPS week 2399, Thursday 00:00:18.
  EXPECT_EQ(gps_from_realtime(seconds(1'767'225'600)), (GpsTime{2399, (4 * 86'400 + 18) * 1'000'000'000LL}));
}

TEST(GpsTime, FromRealtimeKnowsTheLastLeapSecond) {
  const auto before = gps_from_realtime(seconds(1'483'228'799));
  const auto after = gps_from_realtime(seconds(1'483'228'800));
  EXPECT_EQ(after - before, seconds(2));
}

TEST(GpsTime, FromRealtimeRefusesTimesBeforeGps) { EXPECT_THROW(gps_from_realtime(seconds(1000)), std::out_of_range); }

TEST(GpsTime, RealtimeFromGpsUndoesGpsFromRealtime) {
  for (const std::int64_t unix_seconds : {315964800LL, 1483228700LL, 1483228900LL, 1767225600LL}) {
    EXPECT_EQ(realtime_from_gps(gps_from_realtime(seconds(unix_seconds))), seconds(unix_seconds));
  }
}

TEST(DecimalYear, IsTheShareOfTheYearThatHasGoneBy) {
  const auto year_at = [](std::int64_t unix_seconds) { return decimal_year(gps_from_realtime(seconds(unix_seconds))); };
  EXPECT_NEAR(year_at(1'735'689'600), 2025.0, 1e-12);  // 2025-01-01
  EXPECT_NEAR(year_at(1'767'225'599), 2026.0 - 1.0 / 31'536'000, 1e-12);
  EXPECT_NEAR(year_at(1'719'792'000), 2024.0 + 182.0 / 366.0, 1e-12);  // 2024-07-01, a leap year
  EXPECT_NEAR(year_at(951'868'800), 2000.0 + 60.0 / 366.0, 1e-12);     // 2000-03-01
}

TEST(FromSeconds, IsExactToTheNanosecondLateInTheWeek) {
  EXPECT_EQ(from_seconds(604'799.123456789).count() / 100, 604'799'123'456'789 / 100);
  EXPECT_EQ(from_seconds(-0.5), Nanoseconds(-500'000'000));
}

TEST(FromSeconds, RefusesWhatIsNotFinite) {
  EXPECT_THROW(from_seconds(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(from_seconds(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

}  // namespace gps_time_test
}  // namespace inslab::time
