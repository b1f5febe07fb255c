#pragma once

#include <array>
#include <cmath>
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

/// Seconds of week as nanoseconds. Throws ReadError when they do not lie in a week.
inline time::Nanoseconds seconds_of_week(const TextLines& lines, double seconds) {
  if (!(seconds >= 0.0 && seconds <= 604800.0)) {
    throw ReadError(lines.path() + ": line " + std::to_string(lines.number()) +
                    ", column 1: expected seconds of week from 0 to 604800");
  }
  return time::from_seconds(seconds);
}

}  // namespace inslab::io
