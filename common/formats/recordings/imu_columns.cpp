#include "inslab/formats/recordings/imu_columns.hpp"

#include <algorithm>
#include <utility>

#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {

namespace {

struct NamedQuantity {
  const char* before_axis;
  const char* after_axis;
  bool is_gyro;
  bool is_rate;
  double scale;
};

constexpr NamedQuantity kQuantities[] = {
    {"gyro_", "_rad_per_s", true, true, 1.0},
    {"gyro_", "_deg_per_s", true, true, units::kDegPerS},
    {"gyro_", "_deg_per_h", true, true, units::kDegPerH},
    {"dtheta_", "_rad", true, false, 1.0},
    {"dtheta_", "_deg", true, false, units::kDeg},
    {"dtheta_", "_arcsec", true, false, units::kArcsec},
    {"dtheta_b_rad.", "", true, false, 1.0},
    {"accel_", "_m_per_s2", false, true, 1.0},
    {"accel_", "_g", false, true, units::kG},
    {"accel_", "_mgal", false, true, units::kMGal},
    {"dv_", "_m_per_s", false, false, 1.0},
    {"dv_b_m_per_s.", "", false, false, 1.0},
};

constexpr std::pair<const char*, std::int64_t> kTimes[] = {
    {"time_s", 1'000'000'000}, {"time_ms", 1'000'000}, {"time_us", 1'000}, {"time_ns", 1}, {"header.sim_time_ns", 1}};

/// Names and units as other programs write them, "NAME [UNIT]", in lower case.
constexpr const char* kTimeNames[] = {"t", "time", "timestamp", "stamp"};
constexpr const char* kGyroNames[] = {"w_", "w_rs_s_", "gyro_", "omega_", "angular_velocity_", "wx", "gx"};
constexpr const char* kAccelNames[] = {"a_", "a_rs_s_", "acc_", "accel_", "linear_acceleration_", "ax"};
constexpr std::pair<const char*, std::int64_t> kTimeUnits[] = {
    {"s", 1'000'000'000}, {"sec", 1'000'000'000}, {"ms", 1'000'000}, {"us", 1'000}, {"ns", 1}};
constexpr std::pair<const char*, double> kGyroUnits[] = {{"rad/s", 1.0},
                                                         {"rad s^-1", 1.0},
                                                         {"deg/s", units::kDegPerS},
                                                         {"deg s^-1", units::kDegPerS},
                                                         {"deg/h", units::kDegPerH}};
constexpr std::pair<const char*, double> kAccelUnits[] = {
    {"m/s^2", 1.0}, {"m s^-2", 1.0}, {"m/s2", 1.0}, {"g", units::kG}, {"mgal", units::kMGal}};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

template <class Table>
auto found_in(const Table& table, std::string_view name) {
  const auto* entry = std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return name == e.first; });
  return entry == std::end(table) ? nullptr : entry;
}

/// 0 to 2 when the name is one of a triad's for an axis: its beginning and x, y or z ("wx" stands for wx, wy, wz).
template <class Names>
std::optional<int> axis_of(const Names& names, std::string_view name) {
  for (const std::string_view beginning : names) {
    const bool has_axis_inside = beginning.back() == 'x';
    const std::string_view stem = has_axis_inside ? beginning.substr(0, beginning.size() - 1) : beginning;
    if (name.size() != stem.size() + 1 || name.substr(0, stem.size()) != stem) continue;
    if (name.back() >= 'x' && name.back() <= 'z') return name.back() - 'x';
  }
  return std::nullopt;
}

/// "NAME [UNIT]" or "NAME (UNIT)".
std::optional<ImuColumn> bracketed(const std::string& text, std::size_t place) {
  const std::size_t open = text.find_first_of("[("), close = text.find_last_of("])");
  if (open == std::string::npos || close == std::string::npos || close < open) return std::nullopt;
  const std::string_view name = files::trimmed(std::string_view(text).substr(0, open));
  const std::string_view unit = files::trimmed(std::string_view(text).substr(open + 1, close - open - 1));
  ImuColumn column;
  column.place = place;
  if (std::find(std::begin(kTimeNames), std::end(kTimeNames), name) != std::end(kTimeNames)) {
    const auto* time = found_in(kTimeUnits, unit);
    if (time == nullptr) return std::nullopt;
    column.unit_ns = time->second;
    return column;
  }
  column.is_rate = true;
  const auto gyro = axis_of(kGyroNames, name), accel = axis_of(kAccelNames, name);
  const auto* gyro_unit = found_in(kGyroUnits, unit);
  const auto* accel_unit = found_in(kAccelUnits, unit);
  if (gyro && gyro_unit != nullptr) {
    column.axis = *gyro;
    column.scale = gyro_unit->second;
    return column;
  }
  if (!accel || accel_unit == nullptr) return std::nullopt;
  column.axis = 3 + *accel;
  column.scale = accel_unit->second;
  return column;
}

}  // namespace

std::optional<ImuColumn> imu_column_named(std::string_view name, std::size_t place) {
  if (const auto* time = found_in(kTimes, name)) {
    ImuColumn column;
    column.place = place;
    column.unit_ns = time->second;
    return column;
  }
  for (const NamedQuantity& quantity : kQuantities) {
    for (int axis = 0; axis < 3; ++axis) {
      if (name == quantity.before_axis + std::string(1, "xyz"[axis]) + quantity.after_axis) {
        return ImuColumn{place, (quantity.is_gyro ? 0 : 3) + axis, quantity.scale, quantity.is_rate};
      }
    }
  }
  return bracketed(lower(name), place);
}

}  // namespace inslab::recordings
