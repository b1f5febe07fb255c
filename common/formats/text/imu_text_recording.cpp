#include "inslab/formats/text/imu_text_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/error.hpp"

namespace inslab::io {

namespace {

ImuTextLayout layout_of_names(const std::string& path, std::uint64_t line, const std::vector<std::string_view>& names) {
  ImuTextLayout layout;
  layout.fields = names.size();
  std::array<bool, kImuAxes + 1> seen{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = imu_column_named(names[i], i);
    if (!column) continue;
    bool& taken = seen[static_cast<std::size_t>(column->axis + 1)];
    if (taken) {
      throw ReadError(path + ": line " + std::to_string(line) + ": column '" + std::string(names[i]) +
                      "' gives again what another column gives");
    }
    taken = true;
    layout.columns.push_back(*column);
  }
  if (!seen[0] || layout.columns.size() < 2) {
    throw ReadError(path + ": line " + std::to_string(line) +
                    ": expected 7 numbers, or names with a time such as time_s and at least one axis such as "
                    "gyro_x_rad_per_s or accel_x_m_per_s2");
  }
  return layout;
}

/// A line that is numbers alone is data, with the names of a comment above it or else of seven columns; any other is a
/// line of names.
ImuTextLayout layout_of(const std::string& path, std::uint64_t number, std::string_view line,
                        const std::string& names_above) {
  std::vector<std::string_view> fields;
  const char separator = line.find(',') != std::string_view::npos ? ',' : ' ';
  split(line, separator, fields);
  const bool numbers =
      std::all_of(fields.begin(), fields.end(), [](auto text) { return number_from(text).has_value(); });
  ImuTextLayout layout;
  if (numbers && !names_above.empty()) {
    std::vector<std::string_view> names;
    split(names_above, ',', names);
    if (names.size() != fields.size()) {
      throw ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                      " columns; the names above it are " + std::to_string(names.size()));
    }
    layout = layout_of_names(path, number, names);
  } else if (numbers) {
    if (fields.size() != 1 + kImuAxes) {
      throw ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                      " columns without names; expected 7: seconds, dtheta x y z rad, dv x y z m/s");
    }
    layout.fields = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i)
      layout.columns.push_back({i, static_cast<int>(i) - 1, 1.0, false, 1'000'000'000});
  } else {
    layout = layout_of_names(path, number, fields);
  }
  layout.separator = separator;
  return layout;
}

}  // namespace

ImuTextRecording::ImuTextRecording(const std::string& path) : path_(path), lines_(path) {
  if (!next_line()) throw ReadError(path + ": is empty; expected samples of an IMU");
  layout_ = layout_of(path, lines_.number(), line_, names_);
  first_is_data_ = number_from(field(0)).has_value() && all_numbers();
}

bool ImuTextRecording::next(RawImuSample& raw) {
  if (!first_is_data_ && !next_line()) return false;
  first_is_data_ = false;
  split(line_, layout_.separator, fields_);
  const std::string place = path_ + ": line " + std::to_string(lines_.number());
  if (fields_.size() != layout_.fields) {
    throw ReadError(place + ": has " + std::to_string(fields_.size()) + " columns; expected " +
                    std::to_string(layout_.fields));
  }
  raw.place = lines_.number();
  for (const ImuColumn& column : layout_.columns) {
    if (column.axis < 0) {
      raw.time_s = time_of(place, column);
      continue;
    }
    const auto value = number_from(fields_[column.place]);
    if (!value || !std::isfinite(*value)) {
      throw ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
                      std::string(fields_[column.place].substr(0, 40)) + "'; expected a finite number");
    }
    raw.values[static_cast<std::size_t>(column.axis)] = *value * column.scale;
  }
  return true;
}

/// The next line that is no comment. Before the first one a comment may have the names of the columns.
bool ImuTextRecording::next_line() {
  while (lines_.next(line_)) {
    line_ = trimmed(line_);
    if (line_.empty()) continue;
    if (line_.front() != '#' && line_.front() != '%') return true;
    if (layout_.fields == 0) names_ = names_in_comment(line_);
  }
  return false;
}

/// Empty when the comment is not a list of names with a time and an axis among them.
std::string ImuTextRecording::names_in_comment(std::string_view comment) {
  const std::size_t begin = comment.find_first_not_of("#% \t");
  if (begin == std::string_view::npos || comment.find(',') == std::string_view::npos) return "";
  std::vector<std::string_view> names;
  split(comment.substr(begin), ',', names);
  bool has_time = false, has_axis = false;
  for (const std::string_view name : names) {
    const auto column = imu_column_named(name, 0);
    if (column) (column->axis < 0 ? has_time : has_axis) = true;
  }
  return has_time && has_axis ? std::string(comment.substr(begin)) : "";
}

/// Seconds from the first sample.
double ImuTextRecording::time_of(const std::string& place, const ImuColumn& column) {
  const auto ns = exact_nanoseconds(fields_[column.place], column.unit_ns);
  if (!ns) {
    throw ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
                    std::string(fields_[column.place].substr(0, 40)) + "'; expected a time" +
                    (column.unit_ns == 1'000'000'000
                         ? " in seconds; milli-, micro- and nanoseconds need a name, such as time_ns, in a line above"
                         : ""));
  }
  if (!first_ns_) first_ns_ = *ns;
  return static_cast<double>(*ns - *first_ns_) * 1e-9;
}

std::string_view ImuTextRecording::field(std::size_t i) {
  split(line_, layout_.separator, fields_);
  return fields_[i];
}

bool ImuTextRecording::all_numbers() {
  split(line_, layout_.separator, fields_);
  return std::all_of(fields_.begin(), fields_.end(), [](auto text) { return number_from(text).has_value(); });
}

}  // namespace inslab::io
