#include "inslab/formats/trajectory/trajectory_nmea.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/formats/trajectory/trajectory_rows.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/files/calendar_time.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

constexpr time::Nanoseconds kDay = std::chrono::hours(24);
constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Fields of GGA after its name.
enum Gga : std::size_t { kTime = 1, kLat, kNorth, kLon, kEast, kQuality, kSatellites, kHdop, kAltitude, kM, kGeoid };
/// Of RMC.
constexpr std::size_t kRmcStatus = 2, kRmcDate = 9;

/// "hhmmss.ss" since midnight; nothing when it is none.
std::optional<time::Nanoseconds> time_of_day(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hours = files::integer_from(text.substr(0, 2)), minutes = files::integer_from(text.substr(2, 2));
  const auto second_ns = files::exact_nanoseconds(text.substr(4), kSecond_ns);
  const bool is_time = hours && minutes && second_ns && *hours >= 0 && *hours < 24 && *minutes >= 0 && *minutes < 60 &&
                       *second_ns >= 0 && *second_ns < 61 * kSecond_ns;
  if (!is_time) return std::nullopt;
  return time::Nanoseconds((*hours * 3600 + *minutes * 60) * kSecond_ns + *second_ns);
}

/// "ddmm.mmmm" and "N", or "dddmm.mmmm" and "W", as radians; nothing when they are none.
std::optional<double> angle(std::string_view text, std::string_view side, std::size_t degree_digits,
                            std::string_view positive, std::string_view negative) {
  if (text.size() < degree_digits + 2 || (side != positive && side != negative)) return std::nullopt;
  const auto degrees = files::integer_from(text.substr(0, degree_digits));
  const auto minutes = files::number_from(text.substr(degree_digits));
  if (!degrees || !minutes || !(*minutes >= 0.0 && *minutes < 60.0) || *degrees < 0) return std::nullopt;
  const double deg = static_cast<double>(*degrees) + *minutes / 60.0;
  return (side == positive ? deg : -deg) * units::kDeg;
}

/// One in the last decimal of a number, in its unit.
double step_of(std::string_view text) {
  const std::size_t point = text.find('.');
  return point == std::string_view::npos ? 1.0 : std::pow(10.0, -static_cast<double>(text.size() - point - 1));
}

class NmeaReader {
 public:
  NmeaReader(const std::string& path, const TrajectoryReadOptions& options)
      : options_(options), lines_(path), rows_(reading_) {
    std::vector<TextColumn> columns;
    for (const char* name : {"t_s", "lat_deg", "lon_deg", "h_m"}) columns.push_back(column_named(name).value());
    reading_.columns = TextColumns(std::move(columns));
  }

  TrajectoryReading read() {
    for (std::string_view line; !is_done() && lines_.next(line);) {
      line = files::trimmed(line);
      if (is_nmea_sentence(line) && has_good_checksum(line)) sentence(line.substr(1, line.find('*') - 1));
    }
    if (!reading_.file.rows.empty() && first_midnight_) {
      reading_.file.start = time::gps_from_realtime(*first_midnight_ + first_time_);
    }
    return std::move(reading_);
  }

 private:
  bool is_done() const { return rows_.is_full() || (options_.stop_at_first && !reading_.problems.empty()); }

  void fail(Rule rule, const std::string& reason) {
    reading_.problems.add({rule, "line " + std::to_string(lines_.number()), reason});
  }

  /// The exclusive or of what stands between $ and *. A sentence without one is taken.
  bool has_good_checksum(std::string_view line) {
    const std::size_t star = line.find('*');
    if (star == std::string_view::npos) return true;
    unsigned sum = 0;
    for (const char c : line.substr(1, star - 1)) sum ^= static_cast<unsigned char>(c);
    const auto given = files::hex_from(line.substr(star + 1));
    if (given && *given == sum) return true;
    fail(Rule::ValueType, "has a checksum that does not fit what it says");
    return false;
  }

  void sentence(std::string_view text) {
    files::split(text, ',', fields_);
    const std::string_view type = fields_[0].substr(2);
    if (type == "RMC") date();
    if (type == "GGA") fix();
  }

  /// The day that the first row lies in: from the first valid date.
  void date() {
    if (first_midnight_ || fields_.size() <= kRmcDate || fields_[kRmcStatus] != "A") return;
    const std::string_view ddmmyy = fields_[kRmcDate];
    const auto of_day = time_of_day(fields_[kTime]);
    if (ddmmyy.size() != 6 || !of_day) return;
    const std::string text = "20" + std::string(ddmmyy.substr(4, 2)) + "/" + std::string(ddmmyy.substr(2, 2)) + "/" +
                             std::string(ddmmyy.substr(0, 2));
    const auto day = files::gps_from_calendar(text, "00:00:00.0");
    if (!day) return;
    constexpr time::Nanoseconds kGpsBegan = std::chrono::seconds(315'964'800);  // 1980-01-06, as POSIX counts
    const bool is_next_day = last_of_day_ && *last_of_day_ - *of_day > kDay / 2;
    first_midnight_ = (*day - time::GpsTime{}) + kGpsBegan - (days_ + (is_next_day ? 1 : 0)) * kDay;
  }

  void fix() {
    if (fields_.size() <= kGeoid) return fail(Rule::FileColumns, "has too few fields for a GGA");
    if (fields_[kQuality] == "0" || fields_[kQuality].empty()) return;  // no fix
    const auto of_day = time_of_day(fields_[kTime]);
    if (!of_day) return fail(Rule::ValueType, "has no time of day such as 101530.00");
    const auto latitude = angle(fields_[kLat], fields_[kNorth], 2, "N", "S");
    const auto longitude = angle(fields_[kLon], fields_[kEast], 3, "E", "W");
    if (!latitude || !longitude) return fail(Rule::ValueType, "has no position such as 4807.0380,N,01131.0000,E");
    const auto altitude = files::number_from(fields_[kAltitude]), geoid = files::number_from(fields_[kGeoid]);
    if (!altitude || !std::isfinite(*altitude)) return fail(Rule::ValueType, "has no height");
    if (!geoid || !std::isfinite(*geoid)) {
      return fail(Rule::ValueType, "has no height of the geoid, without which that above the ellipsoid is not known");
    }
    TrajectoryRow row;
    row.position = {*latitude, nav::wrapped_to_pi(*longitude), *altitude + *geoid};
    try {
      nav::check_domain(row.position);
    } catch (const std::domain_error& error) {
      return fail(Rule::ValueRange, error.what());
    }
    add(*of_day, row);
  }

  void add(time::Nanoseconds of_day, const TrajectoryRow& row) {
    if (last_of_day_ && *last_of_day_ - of_day > kDay / 2) ++days_;
    last_of_day_ = of_day;
    const time::Nanoseconds t = of_day + days_ * kDay;
    if (reading_.file.rows.empty()) {
      first_time_ = t;
      constexpr double kEarth_m = 6.378137e6;
      const double minute_m = units::kDeg / 60.0 * kEarth_m;
      reading_.step_ned_m = {step_of(fields_[kLat]) * minute_m,
                             step_of(fields_[kLon]) * minute_m * std::cos(row.position.latitude_rad),
                             step_of(fields_[kAltitude])};
    }
    rows_.add(lines_.number(), t, time::GpsTime{}, row);
  }

  const TrajectoryReadOptions& options_;
  files::TextLines lines_;
  TrajectoryReading reading_;
  TrajectoryRows rows_;
  std::vector<std::string_view> fields_;
  std::optional<time::Nanoseconds> last_of_day_;
  std::int64_t days_ = 0;                            ///< since the first row's
  time::Nanoseconds first_time_{0};                  ///< of the first row, since its midnight
  std::optional<time::Nanoseconds> first_midnight_;  ///< CLOCK_REALTIME of that
};

}  // namespace

bool is_nmea_sentence(std::string_view line) {
  const auto is_letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  return line.size() > 7 && line[0] == '$' && line[6] == ',' &&
         std::all_of(line.begin() + 1, line.begin() + 6, is_letter);
}

TrajectoryReading read_trajectory_nmea(const std::string& path, const TrajectoryReadOptions& options) {
  return NmeaReader(path, options).read();
}

}  // namespace inslab::trajectory
