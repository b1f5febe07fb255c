#include "inslab/formats/rinex/rinex_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/files/calendar_time.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::rinex {

namespace {

std::string two_digits(std::string_view text) { return text.size() == 1 ? "0" + std::string(text) : std::string(text); }

/// Seconds, whose whole part has one digit or two.
std::string seconds_text(std::string_view text) {
  const std::size_t whole = std::min(text.find('.'), text.size());
  return two_digits(text.substr(0, whole)) + std::string(text.substr(whole));
}

std::string four_digits(std::string_view year) {
  if (year.size() > 2) return std::string(year);
  const std::string two = two_digits(year);
  return (two >= "80" ? "19" : "20") + two;
}

}  // namespace

std::string_view field_at(std::string_view line, std::size_t begin, std::size_t width) {
  return begin >= line.size() ? std::string_view{} : files::trimmed(line.substr(begin, width));
}

std::optional<double> fortran_number(std::string_view text) {
  if (text.size() > 40) return std::nullopt;
  std::string number(text);
  std::replace_if(
      number.begin(), number.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  const auto value = files::number_from(number);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<SatelliteId> satellite_from(std::string_view text, std::optional<GnssSystem> of_blank) {
  if (text.size() != 3) return std::nullopt;
  const std::size_t place = kSystemLetters.find(text.front());
  const auto number = files::integer_from(files::trimmed(text.substr(1)));
  if (!number || *number < 1 || *number > 99) return std::nullopt;
  const auto id = static_cast<std::uint8_t>(*number);
  if (place != std::string_view::npos) return SatelliteId{static_cast<GnssSystem>(place), id};
  if (text.front() == ' ' && of_blank) return SatelliteId{*of_blank, id};
  return std::nullopt;
}

std::optional<time::GpsTime> calendar_from(std::string_view text) {
  std::vector<std::string_view> parts;
  files::split(text, ' ', parts);
  if (parts.size() != 6) return std::nullopt;
  return files::gps_from_calendar(four_digits(parts[0]) + "-" + two_digits(parts[1]) + "-" + two_digits(parts[2]),
                                  two_digits(parts[3]) + ":" + two_digits(parts[4]) + ":" + seconds_text(parts[5]));
}

time::GpsTime from_utc(const time::GpsTime& calendar) {
  constexpr time::Nanoseconds kGpsBegan = std::chrono::seconds(315'964'800);  // 1980-01-06, since 1970
  return time::gps_from_realtime(calendar - time::GpsTime{} + kGpsBegan);
}

}  // namespace inslab::rinex
