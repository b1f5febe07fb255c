#include "inslab/data/broadcast/system_time.hpp"

#include <stdexcept>

namespace inslab::broadcast {

namespace {

constexpr std::int64_t kDay_ns = 86400 * time::kNsPerSecond;
constexpr std::int64_t kWeek_ns = 7 * kDay_ns;
constexpr std::int64_t kMoscow_ns = 3 * 3600 * time::kNsPerSecond;       // ahead of UTC
constexpr std::int64_t kYear1996_ns = 820'454'400 * time::kNsPerSecond;  // since 1970
constexpr std::int64_t kDaysInFourYears = 1461;

/// The GPS week in which the system's week 0 began.
std::uint32_t first_week(GnssSystem system) {
  switch (system) {
    case GnssSystem::Gps:
    case GnssSystem::Qzss:
      return 0;
    case GnssSystem::Galileo:
      return 1024;
    case GnssSystem::BeiDou:
      return 1356;
    case GnssSystem::Glonass:
      break;
  }
  throw std::invalid_argument("GLONASS time has no weeks");
}

}  // namespace

SystemTime system_time(GnssSystem system, const time::GpsTime& gps) {
  const std::uint32_t first = first_week(system);
  if ((gps - time::GpsTime{first, behind_gps(system).count()}).count() < 0) {
    throw std::out_of_range("a time before week 0 of " + std::string(enum_name(system)));
  }
  const time::GpsTime shown = gps + -behind_gps(system);
  return {shown.week - first, shown.time_of_week_ns};
}

time::GpsTime gps_time(GnssSystem system, const SystemTime& shown) {
  return time::GpsTime{shown.week + first_week(system), shown.time_of_week_ns} + behind_gps(system);
}

GlonassTime glonass_time(const time::GpsTime& gps) {
  const std::int64_t since_1996_ns = time::realtime_from_gps(gps).count() + kMoscow_ns - kYear1996_ns;
  if (since_1996_ns < 0) throw std::out_of_range("GLONASS counts its days from 1996 on");
  const std::int64_t days = since_1996_ns / kDay_ns;
  return {static_cast<std::uint32_t>(days / kDaysInFourYears) + 1,
          static_cast<std::uint32_t>(days % kDaysInFourYears) + 1, since_1996_ns % kDay_ns};
}

time::GpsTime gps_time(const GlonassTime& glonass) {
  const std::int64_t days = (std::int64_t{glonass.four_years} - 1) * kDaysInFourYears + std::int64_t{glonass.day} - 1;
  return time::gps_from_realtime(
      time::Nanoseconds(kYear1996_ns + days * kDay_ns + glonass.time_of_day_ns - kMoscow_ns));
}

time::GpsTime nearest_in_week(const time::GpsTime& near, std::int64_t time_of_week_ns) {
  std::int64_t ahead_ns = (time_of_week_ns - near.time_of_week_ns) % kWeek_ns;
  if (ahead_ns >= kWeek_ns / 2) ahead_ns -= kWeek_ns;
  if (ahead_ns < -kWeek_ns / 2) ahead_ns += kWeek_ns;
  return near + time::Nanoseconds(ahead_ns);
}

std::int64_t time_of_week_ns(GnssSystem system, const time::GpsTime& gps) {
  return (gps + -behind_gps(system)).time_of_week_ns;
}

}  // namespace inslab::broadcast
