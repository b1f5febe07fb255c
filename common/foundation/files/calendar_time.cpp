#include "inslab/foundation/files/calendar_time.hpp"

#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::files {

namespace {

/// Days since 1970-01-01 of a date of the Gregorian calendar, counted in years that begin in March, so that a leap day
/// is the last one: 365 days a year, a leap year every 4 but every 100 and again every 400.
std::int64_t days_from_civil(std::int64_t year, std::int64_t month, std::int64_t day) {
  const std::int64_t y = month <= 2 ? year - 1 : year, months_from_march = (month + 9) % 12;
  const std::int64_t day_of_year = (153 * months_from_march + 2) / 5 + day - 1;
  return 365 * y + y / 4 - y / 100 + y / 400 + day_of_year - 719468;
}

std::optional<std::int64_t> number_between(std::string_view text, std::int64_t least, std::int64_t most) {
  const auto number = integer_from(text);
  return number && *number >= least && *number <= most ? number : std::nullopt;
}

}  // namespace

bool is_calendar_date(std::string_view text) {
  return text.size() == 10 && (text[4] == '/' || text[4] == '-') && text[7] == text[4];
}

std::optional<time::GpsTime> gps_from_calendar(std::string_view date, std::string_view time_of_day) {
  if (!is_calendar_date(date) || time_of_day.size() < 8 || time_of_day[2] != ':' || time_of_day[5] != ':') return {};
  const auto year = number_between(date.substr(0, 4), 1980, 2200), month = number_between(date.substr(5, 2), 1, 12),
             day = number_between(date.substr(8, 2), 1, 31), hour = number_between(time_of_day.substr(0, 2), 0, 23),
             minute = number_between(time_of_day.substr(3, 2), 0, 59);
  const auto second_ns = exact_nanoseconds(time_of_day.substr(6), 1'000'000'000);
  if (!year || !month || !day || !hour || !minute || !second_ns || *second_ns < 0 || *second_ns >= 61'000'000'000) {
    return {};
  }
  constexpr std::int64_t kGpsBegan_days = 3657;  // 1980-01-06
  const std::int64_t days = days_from_civil(*year, *month, *day) - kGpsBegan_days;
  if (days < 0) return {};
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return time::GpsTime{} + time::Nanoseconds((days * 86400 + *hour * 3600 + *minute * 60) * kSecond_ns + *second_ns);
}

}  // namespace inslab::files
