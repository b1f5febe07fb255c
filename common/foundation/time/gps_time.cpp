#include "inslab/foundation/time/gps_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace inslab::time {

namespace {

constexpr std::int64_t kNsPerWeek = 604'800 * kNsPerSecond;
constexpr std::int64_t kGpsEpochUnixSeconds = 315'964'800;  // 1980-01-06T00:00:00Z

struct LeapSecond {
  std::int64_t unix_seconds;  // first second with this offset
  std::int64_t gps_minus_utc_s;
};

// IERS Bulletin C: the dates from which GPS - UTC has grown. Valid as of Bulletin C 70; none announced after 2017.
constexpr std::array<LeapSecond, 19> kLeapSeconds{{
    {315964800, 0},   {362793600, 1},   {394329600, 2},   {425865600, 3},   {489024000, 4},
    {567993600, 5},   {631152000, 6},   {662688000, 7},   {709948800, 8},   {741484800, 9},
    {773020800, 10},  {820454400, 11},  {867715200, 12},  {915148800, 13},  {1136073600, 14},
    {1230768000, 15}, {1341100800, 16}, {1435708800, 17}, {1483228800, 18},
}};

std::int64_t gps_minus_utc_s(std::int64_t unix_seconds) {
  std::int64_t offset_s = 0;
  for (const LeapSecond& leap : kLeapSeconds) {
    if (unix_seconds >= leap.unix_seconds) offset_s = leap.gps_minus_utc_s;
  }
  return offset_s;
}

}  // namespace

Nanoseconds from_seconds(double seconds) {
  if (!std::isfinite(seconds) || std::abs(seconds) > 9.2e9) {
    throw std::invalid_argument("time in seconds is not finite or beyond 292 years");
  }
  // Whole seconds and the rest apart: a double holds 1e9 s to 1e-7 s only, but a table's 604800.005 to the nanosecond.
  const double whole = std::floor(seconds);
  return Nanoseconds(static_cast<std::int64_t>(whole) * kNsPerSecond + std::llround((seconds - whole) * 1e9));
}

GpsTime operator+(const GpsTime& start, Nanoseconds elapsed) {
  const std::int64_t total = start.time_of_week_ns + elapsed.count();
  std::int64_t weeks = total / kNsPerWeek;
  std::int64_t rest = total % kNsPerWeek;
  if (rest < 0) {
    rest += kNsPerWeek;
    --weeks;
  }
  return {static_cast<std::uint32_t>(static_cast<std::int64_t>(start.week) + weeks), rest};
}

Nanoseconds operator-(const GpsTime& a, const GpsTime& b) {
  const std::int64_t weeks = static_cast<std::int64_t>(a.week) - static_cast<std::int64_t>(b.week);
  return Nanoseconds(weeks * kNsPerWeek + a.time_of_week_ns - b.time_of_week_ns);
}

GpsTime gps_from_realtime(Nanoseconds since_1970_utc) {
  const std::int64_t unix_seconds = since_1970_utc.count() / kNsPerSecond;
  if (unix_seconds < kGpsEpochUnixSeconds) {
    throw std::out_of_range("GPS time begins on 1980-01-06");
  }
  const std::int64_t since_epoch_ns =
      since_1970_utc.count() + (gps_minus_utc_s(unix_seconds) - kGpsEpochUnixSeconds) * kNsPerSecond;
  return {static_cast<std::uint32_t>(since_epoch_ns / kNsPerWeek), since_epoch_ns % kNsPerWeek};
}

Nanoseconds realtime_from_gps(const GpsTime& gps) {
  const std::int64_t gps_as_unix_ns =
      static_cast<std::int64_t>(gps.week) * kNsPerWeek + gps.time_of_week_ns + kGpsEpochUnixSeconds * kNsPerSecond;
  // The offset of an instant 18 s off at most: right except within that distance of a leap second, so look twice.
  const std::int64_t first_guess_s = gps_minus_utc_s(gps_as_unix_ns / kNsPerSecond);
  const std::int64_t offset_s = gps_minus_utc_s(gps_as_unix_ns / kNsPerSecond - first_guess_s);
  return Nanoseconds(gps_as_unix_ns - offset_s * kNsPerSecond);
}

double decimal_year(const GpsTime& gps) {
  constexpr double kDaysPerYear = 365.2425;  // of the Gregorian calendar, on average
  constexpr std::uint32_t kLastWeek = 10000;
  const GpsTime capped{std::min(gps.week, kLastWeek), gps.time_of_week_ns};
  const double days = to_seconds(realtime_from_gps(capped)) / 86400.0;  // since 1970-01-01
  // 1 January of year y is day 365 (y - 1970) plus the leap days before it.
  const auto first_day = [](int year) {
    const int before = year - 1;
    const int leap_days = before / 4 - before / 100 + before / 400;
    constexpr int kBefore1970 = 1969 / 4 - 1969 / 100 + 1969 / 400;
    return 365 * (year - 1970) + leap_days - kBefore1970;
  };
  int year = 1970 + static_cast<int>(days / kDaysPerYear);
  if (days >= first_day(year + 1)) ++year;
  if (days < first_day(year)) --year;
  return year + (days - first_day(year)) / (first_day(year + 1) - first_day(year));
}

}  // namespace inslab::time
