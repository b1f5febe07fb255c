#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "io/error.hpp"
#include "io/text_lines.hpp"
#include "time/gps_time.hpp"

namespace inslab::io {

/// The next line of a text of numbers with spaces between, comments (# or %) and empty lines passed over; false at the
/// end. Throws ReadError, naming file, line, column and what was expected, when it is not N finite numbers.
template <std::size_t N>
bool next_numbers(TextLines& lines, std::array<double, N>& numbers) {
  std::string_view line;
  std::vector<std::string_view> fields;
  while (lines.next(line)) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    split(line, ' ', fields);
    const std::string place = lines.path() + ": line " + std::to_string(lines.number());
    if (fields.size() != N) {
      throw ReadError(place + ": has " + std::to_string(fields.size()) + " fields; expected " + std::to_string(N));
    }
    for (std::size_t i = 0; i < N; ++i) {
      const auto number = number_from(fields[i]);
      if (!number || !std::isfinite(*number)) {
        throw ReadError(place + ", column " + std::to_string(i + 1) + ": is '" + std::string(fields[i].substr(0, 40)) +
                        "'; expected a finite number");
      }
      numbers[i] = *number;
    }
    return true;
  }
  return false;
}

/// The seconds of week that lines begin with, as nanoseconds.
class SecondsOfWeek {
 public:
  /// Throws ReadError when they do not lie in a week, or not after those of the line before.
  time::Nanoseconds of_line(const TextLines& lines, double seconds) {
    const std::string place = lines.path() + ": line " + std::to_string(lines.number()) + ", column 1: ";
    if (!(seconds >= 0.0 && seconds <= 604800.0)) {
      throw ReadError(place + "expected seconds of week from 0 to 604800");
    }
    const time::Nanoseconds in_week = time::from_seconds(seconds);
    if (last_ && in_week <= *last_) {
      throw ReadError(place + "is " + std::to_string(seconds) + " after " + std::to_string(time::to_seconds(*last_)) +
                      "; expected time to go on");
    }
    last_ = in_week;
    return in_week;
  }

 private:
  std::optional<time::Nanoseconds> last_;
};

}  // namespace inslab::io
