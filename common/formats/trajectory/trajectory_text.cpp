#include "inslab/formats/trajectory/trajectory_text.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/formats/trajectory/rtklib_columns.hpp"
#include "inslab/formats/trajectory/trajectory_rows.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/files/calendar_time.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kLongestTime_s = 9.2e9;  // 292 years in nanoseconds: Unix time has its place
constexpr std::int64_t kWeekNs = 604'800'000'000'000;

/// What the numbers of a quantity may be, in the unit in which the message speaks.
struct Range {
  double minimum;
  double maximum;
  double unit;  ///< in SI
  const char* unit_name;
};

Range range_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::GpsWeek:
      return {0.0, time::kLastGpsWeek, 1.0, ""};
    case Quantity::SecondOfWeek:
      return {0.0, 604800.0, 1.0, " s"};
    case Quantity::Latitude:
      return {-nav::kMaxLatitudeDeg, nav::kMaxLatitudeDeg, units::kDeg, " deg"};
    case Quantity::Longitude:
      return {-180.0, 360.0, units::kDeg, " deg"};
    case Quantity::Height:
      return {nav::kMinHeightM, nav::kMaxHeightM, 1.0, " m"};
    case Quantity::VelocityNorth:
    case Quantity::VelocityEast:
    case Quantity::VelocityDown:
      return {-1e4, 1e4, 1.0, " m/s"};
    case Quantity::Roll:
      return {-180.0, 180.0, units::kDeg, " deg"};
    case Quantity::Pitch:
      return {-90.0, 90.0, units::kDeg, " deg"};
    case Quantity::Yaw:
      return {-360.0, 360.0, units::kDeg, " deg"};
    case Quantity::QuaternionW:
    case Quantity::QuaternionX:
    case Quantity::QuaternionY:
    case Quantity::QuaternionZ:
      return {-1.001, 1.001, 1.0, ""};
    case Quantity::Time:
    case Quantity::Ignored:
      break;
  }
  return {-kLongestTime_s, kLongestTime_s, 1.0, " s"};
}

/// How long a unit of a column of time is.
std::int64_t unit_ns_of(const TextColumn& column) { return std::llround(column.scale * 1e9); }

class TextReader {
 public:
  TextReader(const std::string& path, const TrajectoryReadOptions& options)
      : options_(options), lines_(path), rows_(reading_) {}

  TrajectoryReading read() {
    std::string_view line;
    while (lines_.next(line) && !is_done()) {
      line = files::trimmed(line);
      if (line.empty()) continue;
      if (line.front() == '#' || line.front() == '%') {
        if (!has_columns()) keep_names_in_comment(line);
        continue;
      }
      if (has_columns()) {
        add_row(line);
        continue;
      }
      separator_ = line.find(',') == std::string_view::npos ? ' ' : ',';
      files::split(line, separator_, fields_);
      // Without columns no line can be read: the first problem is the last.
      if (!find_columns(line)) break;
    }
    reading_.step_ned_m = step_ned_m();
    return std::move(reading_);
  }

 private:
  bool has_columns() const { return reading_.columns.size() > 0; }
  bool is_done() const { return rows_.is_full() || (options_.stop_at_first && !reading_.problems.empty()); }

  void fail(Rule rule, std::size_t column, const std::string& reason) {
    std::string place = "line " + std::to_string(lines_.number());
    if (column < reading_.columns.size()) {
      place += ", column " + std::to_string(column + 1) + " (" + reading_.columns[column].name + ")";
    }
    reading_.problems.add({rule, place, reason});
  }
  void fail_line(Rule rule, const std::string& reason) { fail(rule, kQuantities * kQuantities, reason); }

  /// The names of columns stand in a comment of some files. Where most are known, one that is not is remembered: it is
  /// why the names cannot be used.
  void keep_names_in_comment(std::string_view line) {
    const std::size_t begin = line.find_first_not_of("#% \t");
    if (begin == std::string_view::npos) return;
    if (auto columns = rtklib_columns(line.substr(begin))) {
      from_comment_ = std::move(*columns);
      return;
    }
    std::vector<std::string_view> names;
    files::split(line.substr(begin), line.find(',') == std::string_view::npos ? ' ' : ',', names);
    std::vector<TextColumn> columns;
    std::string unknown;
    for (const std::string_view name : names) {
      const auto column = column_named(name);
      if (!column && unknown.empty()) unknown = std::string(name.substr(0, 40));
      if (column) columns.push_back(*column);
    }
    if (columns.size() < 4) return;
    not_understood_ = unknown;
    if (unknown.empty()) from_comment_ = TextColumns(std::move(columns));
  }

  /// Sets the columns from the first line that is no comment, whose fields are split; that line is a row unless it has
  /// the names. False, with a problem, when they cannot be told.
  bool find_columns(std::string_view line) {
    const bool is_dated = from_comment_.size() > 0 && files::is_calendar_date(fields_.front());
    const bool is_row = std::all_of(fields_.begin() + (is_dated ? 2 : 0), fields_.end(),
                                    [](std::string_view field) { return files::number_from(field).has_value(); });
    std::optional<TextColumns> columns;
    if (!is_row) {
      columns = columns_from(fields_);
    } else if (!options_.columns.empty()) {
      std::vector<std::string_view> names;
      files::split(options_.columns, ',', names);
      columns = columns_from(names);
    } else if (from_comment_.size() > 0) {
      columns = from_comment_;
    } else {
      columns = columns_of_numbers();
    }
    if (!columns) return false;
    if (const auto problem = columns->problem()) {
      fail_line(Rule::FileColumns, *problem);
      return false;
    }
    reading_.columns = std::move(*columns);
    if (is_row) add_row(line);
    return true;
  }

  std::optional<TextColumns> columns_of_numbers() {
    auto columns = separator_ == ' ' ? columns_of_plain_text(fields_.size()) : std::nullopt;
    if (!columns) {
      const std::string names = not_understood_.empty()
                                    ? "no line of names was above it"
                                    : "of the names above it '" + not_understood_ + "' is not understood";
      fail_line(Rule::FileColumns, "has " + std::to_string(fields_.size()) + " numbers and " + names +
                                       "; expected names such as t_s,lat_deg,lon_deg,h_m (with --columns, where '-' "
                                       "leaves a column aside), or 11, 7 or 13 numbers with spaces between");
    }
    return columns;
  }

  std::optional<TextColumns> columns_from(const std::vector<std::string_view>& names) {
    std::vector<TextColumn> columns;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto column = column_named(names[i]);
      if (!column) {
        fail_line(Rule::FileColumns, "column " + std::to_string(i + 1) + " is '" + std::string(names[i].substr(0, 40)) +
                                         "'; expected the name of a column with its unit, such as t_s, sow_s, lat_deg, "
                                         "lon_deg, h_m, vn_mps, ve_mps, vd_mps, roll_deg, pitch_deg, yaw_deg, or '-' "
                                         "to leave the column aside");
        return std::nullopt;
      }
      columns.push_back(*column);
    }
    return TextColumns(std::move(columns));
  }

  void add_row(std::string_view line) {
    files::split(line, separator_, fields_);
    if (fields_.size() != reading_.columns.size()) {
      fail_line(Rule::FileColumns, "has " + std::to_string(fields_.size()) + " fields; expected " +
                                       std::to_string(reading_.columns.size()));
      return;
    }
    if (files::is_calendar_date(fields_.front()) && !date_to_week()) return;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (!read_field(i)) return;
    }
    TrajectoryRow row;
    if (fill(row)) rows_.add(lines_.number(), time_of_row(), start_of_row(), row);
  }

  /// A calendar date and a time of day in GPS time, in place of week and seconds of week.
  bool date_to_week() {
    const auto time = files::gps_from_calendar(fields_[0], fields_[1]);
    if (!time) {
      fail(Rule::ValueType, 0,
           "is '" + std::string(fields_[0].substr(0, 20)) + " " + std::string(fields_[1].substr(0, 20)) +
               "'; expected a date and a time such as 2024/03/05 10:00:00.000");
      return false;
    }
    week_text_ = std::to_string(time->week);
    second_text_ = std::to_string(time->time_of_week_ns / 1'000'000'000) + "." +
                   std::to_string(1'000'000'000 + time->time_of_week_ns % 1'000'000'000).substr(1);
    fields_[0] = week_text_;
    fields_[1] = second_text_;
    return true;
  }

  bool read_field(std::size_t i) {
    const TextColumn& column = reading_.columns[i];
    if (column.quantity == Quantity::Ignored) return true;
    const auto number = files::number_from(fields_[i]);
    if (!number) {
      fail(Rule::ValueType, i, "is '" + std::string(fields_[i].substr(0, 40)) + "'; expected a number");
      return false;
    }
    const Range range = range_of(column.quantity);
    const double factor = std::abs(column.scale) / range.unit;
    const double value = *number * factor;
    // Radians at the end of a range may lie beyond it by the rounding of their degrees.
    const double slack = factor == 1.0 ? 0.0 : 1e-9;
    if (!(value >= range.minimum - slack && value <= range.maximum + slack)) {
      fail(Rule::ValueRange, i,
           std::isfinite(value) ? "is " + number_text(value) + range.unit_name + "; expected " +
                                      number_text(range.minimum) + " to " + number_text(range.maximum)
                                : "is " + std::string(fields_[i]) + "; expected a finite number");
      return false;
    }
    values_[static_cast<std::size_t>(column.quantity)] = *number * column.scale;
    note_decimals(column.quantity, fields_[i]);
    if (column.quantity == Quantity::Time)
      time_ns_ = files::exact_nanoseconds(fields_[i], unit_ns_of(column)).value_or(0);
    return true;
  }

  /// The most decimals that a column of positions has: a number may end in zeros that are not written.
  void note_decimals(Quantity quantity, std::string_view field) {
    const auto axis = static_cast<std::size_t>(quantity) - static_cast<std::size_t>(Quantity::Latitude);
    if (quantity < Quantity::Latitude || axis >= decimals_.size()) return;
    constexpr int kNotRounded = 17;
    const std::size_t point = field.find('.');
    const bool has_exponent = field.find_first_of("eE") != std::string_view::npos;
    const int count = has_exponent                      ? kNotRounded
                      : point == std::string_view::npos ? 0
                                                        : static_cast<int>(field.size() - point - 1);
    decimals_[axis] = std::max(decimals_[axis], count);
  }

  /// One in the last decimal, m.
  nav::Vector3 step_ned_m() const {
    constexpr double kEarth_m = 6.378137e6;
    if (reading_.file.rows.empty()) return nav::Vector3::Zero();
    const double parallel_m = kEarth_m * std::cos(reading_.file.rows.front().position.latitude_rad);
    const auto step = [this](Quantity quantity, double unit_m) {
      const TextColumn& column = reading_.columns[*reading_.columns.find(quantity)];
      const auto axis = static_cast<std::size_t>(quantity) - static_cast<std::size_t>(Quantity::Latitude);
      return std::abs(column.scale) * unit_m * std::pow(10.0, -decimals_[axis]);
    };
    return {step(Quantity::Latitude, kEarth_m), step(Quantity::Longitude, parallel_m), step(Quantity::Height, 1.0)};
  }

  double value(Quantity quantity) const { return values_[static_cast<std::size_t>(quantity)]; }

  bool fill(TrajectoryRow& row) {
    row.position = {value(Quantity::Latitude), nav::wrapped_to_pi(value(Quantity::Longitude)), value(Quantity::Height)};
    if (reading_.columns.has_velocity()) {
      row.v_n = {value(Quantity::VelocityNorth), value(Quantity::VelocityEast), value(Quantity::VelocityDown)};
    }
    if (reading_.columns.has(Quantity::Roll)) {
      row.rpy = nav::RollPitchYaw{value(Quantity::Roll), value(Quantity::Pitch), value(Quantity::Yaw)};
    } else if (reading_.columns.has(Quantity::QuaternionW)) {
      const nav::Quaternion q_nv(value(Quantity::QuaternionW), value(Quantity::QuaternionX),
                                 value(Quantity::QuaternionY), value(Quantity::QuaternionZ));
      if (std::abs(q_nv.norm() - 1.0) > 1e-3) {
        fail(Rule::ValueRange, *reading_.columns.find(Quantity::QuaternionW),
             "begins a quaternion of norm " + number_text(q_nv.norm()) + "; expected 1");
        return false;
      }
      row.rpy = nav::rpy_from_quaternion(q_nv);
    }
    return true;
  }

  /// From a zero that all rows share.
  time::Nanoseconds time_of_row() {
    if (reading_.columns.has(Quantity::Time)) return time::Nanoseconds(time_ns_);
    const time::Nanoseconds in_week = time::from_seconds(value(Quantity::SecondOfWeek));
    std::int64_t week = std::llround(value(Quantity::GpsWeek));  // 0 when there is no such column
    if (week == 0) {
      if (in_week_before_ - in_week > time::Nanoseconds(kWeekNs / 2)) ++weeks_passed_;
      in_week_before_ = in_week;
      week = weeks_passed_;
    }
    return in_week + time::Nanoseconds(week * kWeekNs);
  }

  time::GpsTime start_of_row() const {
    if (reading_.columns.has(Quantity::Time)) {
      // Unix time says when it was; a time of its own zero does not, and before it there is no GPS time to name.
      constexpr std::int64_t kUnixFrom_ns = 1'000'000'000'000'000'000;  // 2001
      if (time_ns_ >= kUnixFrom_ns) return time::gps_from_realtime(time::Nanoseconds(time_ns_));
      return time::GpsTime{} + std::max(time::Nanoseconds(0), time::Nanoseconds(time_ns_));
    }
    return time::GpsTime{static_cast<std::uint32_t>(std::llround(value(Quantity::GpsWeek))), 0} +
           time::from_seconds(value(Quantity::SecondOfWeek));
  }

  const TrajectoryReadOptions& options_;
  files::TextLines lines_;
  TrajectoryReading reading_;
  TrajectoryRows rows_;
  TextColumns from_comment_;
  std::string not_understood_;  ///< a name in a comment that most of whose names are known
  std::string week_text_, second_text_;
  std::int64_t time_ns_ = 0;  ///< of the line, as Quantity::Time has it
  char separator_ = ' ';
  std::vector<std::string_view> fields_;
  std::array<double, kQuantities> values_{};
  std::array<int, 3> decimals_{};  ///< of latitude, longitude, height
  time::Nanoseconds in_week_before_{0};
  std::int64_t weeks_passed_ = 0;
};

}  // namespace

TrajectoryReading read_trajectory_text(const std::string& path, const TrajectoryReadOptions& options) {
  return TextReader(path, options).read();
}

}  // namespace inslab::trajectory
