#pragma once

#include <chrono>
#include <cstdint>

namespace inslab::time {

/// Typed 64-bit nanoseconds: sim time (since the scenario's start) and intervals.
using Nanoseconds = std::chrono::nanoseconds;

/// Seconds as double, for the models; exact to 1e-16 relative.
inline constexpr std::int64_t kNsPerSecond = 1'000'000'000;

constexpr double to_seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }
constexpr double to_seconds(Nanoseconds t) { return to_seconds(t.count()); }

/// Nearest nanosecond of `seconds`. Throws std::invalid_argument when it is not finite or beyond 292 years.
Nanoseconds from_seconds(double seconds);

/// The last week that anything here is about: the year 2171.
inline constexpr std::uint32_t kLastGpsWeek = 10'000;

/// GPS time: full week number (no rollover) and nanoseconds into the week, kept in [0, 604800 s).
struct GpsTime {
  std::uint32_t week = 0;
  std::int64_t time_of_week_ns = 0;

  friend bool operator==(const GpsTime& a, const GpsTime& b) {
    return a.week == b.week && a.time_of_week_ns == b.time_of_week_ns;
  }
};

/// `start` plus `elapsed`; weeks carry.
GpsTime operator+(const GpsTime& start, Nanoseconds elapsed);

/// `a - b`.
Nanoseconds operator-(const GpsTime& a, const GpsTime& b);

/// GPS time of a CLOCK_REALTIME reading (UTC, as POSIX counts it), with the leap seconds of IERS Bulletin C 70
/// (July 2025): 18 s since 2017-01-01. Throws std::out_of_range before 1980-01-06.
GpsTime gps_from_realtime(Nanoseconds since_1970_utc);

/// The year and its part that has gone by at a GPS time, in UTC: 2025.5 is the middle of 2025. Weeks from 10000 on, the
/// year 2171, count as that one.
double decimal_year(const GpsTime& gps);

/// The CLOCK_REALTIME reading at a GPS time; undoes gps_from_realtime except within a leap second.
Nanoseconds realtime_from_gps(const GpsTime& gps);

}  // namespace inslab::time
