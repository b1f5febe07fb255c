#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::files {

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

/// The seconds of week that lines begin with, as nanoseconds from the beginning of the first line's week.
class SecondsOfWeek {
 public:
  static constexpr time::Nanoseconds kWeek = std::chrono::hours(7 * 24);

  /// Seconds that fall by more than half a week begin the next week. Throws ReadError when they do not lie in a week,
  /// or not after those of the line before.
  time::Nanoseconds of_line(const TextLines& lines, double seconds) {
    const std::string place = lines.path() + ": line " + std::to_string(lines.number()) + ", column 1: ";
    if (!(seconds >= 0.0 && seconds <= 604800.0)) {
      throw ReadError(place + "is " + std::to_string(seconds) + "; expected seconds of week from 0 to 604800");
    }
    time::Nanoseconds from_first_week = time::from_seconds(seconds) + weeks_ * kWeek;
    if (last_ && *last_ - from_first_week > kWeek / 2) {
      ++weeks_;
      from_first_week += kWeek;
    }
    if (last_ && from_first_week <= *last_) {
      throw ReadError(place + "is " + std::to_string(seconds) + " after " +
                      std::to_string(time::to_seconds(*last_ % kWeek)) + "; expected time to go on");
    }
    last_ = from_first_week;
    return from_first_week;
  }

 private:
  std::optional<time::Nanoseconds> last_;
  int weeks_ = 0;
};

}  // namespace inslab::files
