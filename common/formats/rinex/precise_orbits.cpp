#include "inslab/formats/rinex/precise_orbits.hpp"

#include "inslab/formats/rinex/rinex_lines.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::rinex {

namespace {

[[noreturn]] void refuse_line_of(const files::TextLines& lines, const std::string& why) {
  throw files::ReadError(lines.path() + ": line " + std::to_string(lines.number()) + ": " + why);
}

double number_of(const files::TextLines& lines, std::string_view line, std::size_t begin) {
  constexpr std::size_t kWidth = 14;
  const std::string_view text = field_at(line, begin, kWidth);
  const auto number = fortran_number(text);
  if (!number)
    refuse_line_of(lines,
                   "has '" + std::string(text) + "' in column " + std::to_string(begin + 1) + "; expected a number");
  return *number;
}

PreciseState state_of(const files::TextLines& lines, std::string_view line, const SatelliteId& satellite) {
  constexpr double kNoClock_us = 999999.0;
  const Vector3 r_km(number_of(lines, line, 4), number_of(lines, line, 18), number_of(lines, line, 32));
  const double clock_us = number_of(lines, line, 46);
  PreciseState state{satellite, {}, {}};
  if (!r_km.isZero(0.0)) state.r_e_m = 1000.0 * r_km;
  if (clock_us < kNoClock_us) state.clock_s = 1e-6 * clock_us;
  return state;
}

}  // namespace

std::vector<PreciseEpoch> read_precise_orbits(const std::string& path) {
  files::TextLines lines(path);
  std::string_view line;
  if (!lines.next(line) || line.size() < 2 || line[0] != '#' || (line[1] != 'c' && line[1] != 'd')) {
    refuse_line_of(lines, "is no header of SP3; expected #c or #d");
  }
  std::vector<PreciseEpoch> epochs;
  bool is_time_known = false;
  while (lines.next(line)) {
    if (line.substr(0, 3) == "EOF") return epochs;
    if (line.substr(0, 2) == "%c" && !is_time_known) {
      if (field_at(line, 9, 3) != "GPS") {
        refuse_line_of(lines, "has the time '" + std::string(field_at(line, 9, 3)) + "'; expected GPS");
      }
      is_time_known = true;
    } else if (!line.empty() && line[0] == '*') {
      const auto gps = calendar_from(field_at(line, 3, 28));
      if (!gps || !is_time_known) refuse_line_of(lines, "is no epoch; expected * and a date, after a line %c");
      epochs.push_back({*gps, {}});
    } else if (!line.empty() && line[0] == 'P') {
      if (epochs.empty()) refuse_line_of(lines, "stands before the first epoch");
      const auto satellite = line.size() < 4 ? std::nullopt : satellite_from(line.substr(1, 3));
      if (satellite) epochs.back().states.push_back(state_of(lines, line, *satellite));
    }
  }
  refuse_line_of(lines, "is the last; expected EOF");
}

}  // namespace inslab::rinex
