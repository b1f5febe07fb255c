#pragma once

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

/// The times of the systems. Offsets of some nanoseconds between them (GGTO and its like) are no part of it: those
/// stand in the clocks of the satellites.
namespace inslab::broadcast {

/// A week and the time in it as a system counts them.
struct SystemTime {
  std::uint32_t week = 0;
  std::int64_t time_of_week_ns = 0;
};

/// The system's own week and time of week: of Galileo the GPS week less 1024 (OS SIS ICD, 5.1.2), of BeiDou 14 s behind
/// GPS from GPS week 1356 on (B1I ICD, 3.3); QZSS counts as GPS. Throws std::invalid_argument for GLONASS, which knows
/// no weeks, std::out_of_range before the system's week 0.
SystemTime system_time(GnssSystem system, const time::GpsTime& gps);

/// Undoes system_time().
time::GpsTime gps_time(GnssSystem system, const SystemTime& shown);

/// The time of GLONASS, UTC + 3 h (GLONASS ICD 5.1, 3.3.3 and table 4.6). A leap second counts as the first second of
/// what comes after it.
struct GlonassTime {
  std::uint32_t four_years = 1;     ///< N4: from 1996 on, the first is 1
  std::uint32_t day = 1;            ///< NT: of the four years, from 1 to 1461
  std::int64_t time_of_day_ns = 0;  ///< of Moscow
};

/// Throws std::out_of_range before 1996.
GlonassTime glonass_time(const time::GpsTime& gps);
time::GpsTime gps_time(const GlonassTime& glonass);

/// The GPS time that lies `time_of_week_ns` into some week and nearest to `near`: fields of weeks differ between files.
time::GpsTime nearest_in_week(const time::GpsTime& near, std::int64_t time_of_week_ns);

/// Nanoseconds into the system's week that `gps` lies in; of GLONASS into that of GPS.
std::int64_t time_of_week_ns(GnssSystem system, const time::GpsTime& gps);

/// What the time of a system is behind GPS time in its weeks: 14 s of BeiDou.
constexpr time::Nanoseconds behind_gps(GnssSystem system) {
  return system == GnssSystem::BeiDou ? std::chrono::seconds(14) : std::chrono::seconds(0);
}

}  // namespace inslab::broadcast
