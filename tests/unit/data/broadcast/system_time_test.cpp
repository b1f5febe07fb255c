#include "inslab/data/broadcast/system_time.hpp"

#include <gmock/gmock.h>

namespace inslab::broadcast {
namespace system_time_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kWeek_ns = 604'800 * kSecond_ns;

// The weeks are those that the records of 2023-01-08 in RINEX files have; BeiDou's second of the week is 14 behind.
TEST(SystemTime, WeeksOfTheSystemsAtOneInstant) {
  const time::GpsTime gps{2244, 36014 * kSecond_ns};
  EXPECT_EQ(system_time(GnssSystem::Gps, gps).week, 2244u);
  EXPECT_EQ(system_time(GnssSystem::Qzss, gps).week, 2244u);
  EXPECT_EQ(system_time(GnssSystem::Galileo, gps).week, 1220u);
  EXPECT_EQ(system_time(GnssSystem::Galileo, gps).time_of_week_ns, 36014 * kSecond_ns);
  EXPECT_EQ(system_time(GnssSystem::BeiDou, gps).week, 888u);
  EXPECT_EQ(system_time(GnssSystem::BeiDou, gps).time_of_week_ns, 36000 * kSecond_ns);
}

TEST(SystemTime, BeiDouBeginsItsWeekFourteenSecondsLater) {
  const SystemTime before = system_time(GnssSystem::BeiDou, {2244, 14 * kSecond_ns - 1});
  EXPECT_EQ(before.week, 887u);
  EXPECT_EQ(before.time_of_week_ns, kWeek_ns - 1);
  EXPECT_EQ(system_time(GnssSystem::BeiDou, {2244, 14 * kSecond_ns}).week, 888u);
  EXPECT_EQ(time_of_week_ns(GnssSystem::BeiDou, {2244, 5}), kWeek_ns - 14 * kSecond_ns + 5);
}

TEST(SystemTime, GoesThereAndBack) {
  const time::GpsTime gps{2401, 604'799'999'999'999};
  for (const auto system : {GnssSystem::Gps, GnssSystem::Galileo, GnssSystem::BeiDou, GnssSystem::Qzss}) {
    EXPECT_EQ(gps_time(system, system_time(system, gps)), gps) << enum_name(system);
  }
}

TEST(SystemTime, NoWeekBeforeASystemsFirst) {
  EXPECT_THROW(system_time(GnssSystem::BeiDou, {1356, 14 * kSecond_ns - 1}), std::out_of_range);
  EXPECT_EQ(system_time(GnssSystem::BeiDou, {1356, 14 * kSecond_ns}).week, 0u);
  EXPECT_THROW(system_time(GnssSystem::Galileo, {1023, 0}), std::out_of_range);
  EXPECT_THROW(system_time(GnssSystem::Glonass, {2244, 0}), std::invalid_argument);
}

// 2023-01-08 00:15:00 UTC is 03:15:00 in Moscow and 00:15:18 of GPS. The seventh four years began on 2020-01-01; 366
// and twice 365 days later it is 2023-01-01.
TEST(GlonassTime, DayOfFourYearsAndTimeOfDay) {
  const time::GpsTime gps{2244, 918 * kSecond_ns};
  const GlonassTime glonass = glonass_time(gps);
  EXPECT_EQ(glonass.four_years, 7u);
  EXPECT_EQ(glonass.day, 366u + 365u + 365u + 8u);
  EXPECT_EQ(glonass.time_of_day_ns, (3 * 3600 + 15 * 60) * kSecond_ns);
  EXPECT_EQ(gps_time(glonass), gps);
}

// 2016-12-31 23:59:60 UTC was a leap second: between 23:59:59 (GPS 16 s into Sunday) and midnight (18 s) lie two
// seconds.
TEST(GlonassTime, LeapSecondLiesBetweenTwoDays) {
  EXPECT_EQ(glonass_time({1930, 16 * kSecond_ns}).time_of_day_ns, (3 * 3600 - 1) * kSecond_ns);
  EXPECT_EQ(glonass_time({1930, 18 * kSecond_ns}).time_of_day_ns, 3 * 3600 * kSecond_ns);
  EXPECT_EQ(gps_time(GlonassTime{6, 367, 3 * 3600 * kSecond_ns}), (time::GpsTime{1930, 18 * kSecond_ns}));
}

TEST(GlonassTime, CountsFrom1996On) { EXPECT_THROW(glonass_time({700, 0}), std::out_of_range); }

TEST(NearestInWeek, TakesTheWeekOnEitherSide) {
  const time::GpsTime near{2244, 100 * kSecond_ns};
  EXPECT_EQ(nearest_in_week(near, kWeek_ns - 5), (time::GpsTime{2243, kWeek_ns - 5}));
  EXPECT_EQ(nearest_in_week(near, 7200 * kSecond_ns), (time::GpsTime{2244, 7200 * kSecond_ns}));
  EXPECT_EQ(nearest_in_week({2243, kWeek_ns - 7}, 0), (time::GpsTime{2244, 0}));
}

}  // namespace system_time_test
}  // namespace inslab::broadcast
