#include "inslab/formats/trajectory/trajectory_columns.hpp"

#include <algorithm>

#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

struct Spelling {
  std::string_view name;
  Quantity quantity;
  double scale;
};

constexpr double kMs = 1e-3;
constexpr double kUs = 1e-6;
constexpr double kNs = 1e-9;
constexpr double kUp = -1.0;

/// Every name carries its unit, except where only one is possible. A height "alt" or "msl" is not here on purpose: it
/// would be above the geoid, and the trajectory's is above the ellipsoid.
constexpr Spelling kSpellings[] = {
    {"t", Quantity::Time, 1.0},
    {"t_s", Quantity::Time, 1.0},
    {"time_s", Quantity::Time, 1.0},
    {"sim_time_s", Quantity::Time, 1.0},
    {"timestamp_s", Quantity::Time, 1.0},
    {"unix_s", Quantity::Time, 1.0},
    {"t_ms", Quantity::Time, kMs},
    {"time_ms", Quantity::Time, kMs},
    {"timestamp_ms", Quantity::Time, kMs},
    {"t_us", Quantity::Time, kUs},
    {"time_us", Quantity::Time, kUs},
    {"timestamp_us", Quantity::Time, kUs},
    {"timestamp_ns", Quantity::Time, kNs},
    {"t_ns", Quantity::Time, kNs},
    {"time_ns", Quantity::Time, kNs},
    {"sim_time_ns", Quantity::Time, kNs},
    {"header.sim_time_ns", Quantity::Time, kNs},
    {"week", Quantity::GpsWeek, 1.0},
    {"gps_week", Quantity::GpsWeek, 1.0},
    {"sow", Quantity::SecondOfWeek, 1.0},
    {"sow_s", Quantity::SecondOfWeek, 1.0},
    {"tow_s", Quantity::SecondOfWeek, 1.0},
    {"gps_sow_s", Quantity::SecondOfWeek, 1.0},
    {"gps_tow_s", Quantity::SecondOfWeek, 1.0},
    {"seconds_of_week_s", Quantity::SecondOfWeek, 1.0},
    {"gps_seconds_of_week_s", Quantity::SecondOfWeek, 1.0},
    {"lat_deg", Quantity::Latitude, units::kDeg},
    {"latitude_deg", Quantity::Latitude, units::kDeg},
    {"lat_rad", Quantity::Latitude, 1.0},
    {"latitude_rad", Quantity::Latitude, 1.0},
    {"lon_deg", Quantity::Longitude, units::kDeg},
    {"longitude_deg", Quantity::Longitude, units::kDeg},
    {"lon_rad", Quantity::Longitude, 1.0},
    {"longitude_rad", Quantity::Longitude, 1.0},
    {"h_m", Quantity::Height, 1.0},
    {"height_m", Quantity::Height, 1.0},
    {"ellipsoidal_height_m", Quantity::Height, 1.0},
    {"vn_mps", Quantity::VelocityNorth, 1.0},
    {"vn_m_per_s", Quantity::VelocityNorth, 1.0},
    {"v_n_mps", Quantity::VelocityNorth, 1.0},
    {"v_north_m_per_s", Quantity::VelocityNorth, 1.0},
    {"v_n_m_per_s.x", Quantity::VelocityNorth, 1.0},
    {"ve_mps", Quantity::VelocityEast, 1.0},
    {"ve_m_per_s", Quantity::VelocityEast, 1.0},
    {"v_e_mps", Quantity::VelocityEast, 1.0},
    {"v_east_m_per_s", Quantity::VelocityEast, 1.0},
    {"v_n_m_per_s.y", Quantity::VelocityEast, 1.0},
    {"vd_mps", Quantity::VelocityDown, 1.0},
    {"vd_m_per_s", Quantity::VelocityDown, 1.0},
    {"v_d_mps", Quantity::VelocityDown, 1.0},
    {"v_down_m_per_s", Quantity::VelocityDown, 1.0},
    {"v_n_m_per_s.z", Quantity::VelocityDown, 1.0},
    {"vu_mps", Quantity::VelocityDown, kUp},
    {"vu_m_per_s", Quantity::VelocityDown, kUp},
    {"v_up_m_per_s", Quantity::VelocityDown, kUp},
    {"roll_deg", Quantity::Roll, units::kDeg},
    {"roll_rad", Quantity::Roll, 1.0},
    {"pitch_deg", Quantity::Pitch, units::kDeg},
    {"pitch_rad", Quantity::Pitch, 1.0},
    {"yaw_deg", Quantity::Yaw, units::kDeg},
    {"heading_deg", Quantity::Yaw, units::kDeg},
    {"yaw_rad", Quantity::Yaw, 1.0},
    {"heading_rad", Quantity::Yaw, 1.0},
    {"q_nv.w", Quantity::QuaternionW, 1.0},
    {"q_nv.x", Quantity::QuaternionX, 1.0},
    {"q_nv.y", Quantity::QuaternionY, 1.0},
    {"q_nv.z", Quantity::QuaternionZ, 1.0},
    {"interval_ns", Quantity::Ignored, 1.0},
    {"segment_index", Quantity::Ignored, 1.0},
    {"rate_jump", Quantity::Ignored, 1.0},
    {"journal_in_effect", Quantity::Ignored, 1.0},
    {"-", Quantity::Ignored, 1.0},
    {"q", Quantity::Ignored, 1.0},
    {"ns", Quantity::Ignored, 1.0},
    {"age", Quantity::Ignored, 1.0},
    {"age_s", Quantity::Ignored, 1.0},
    {"ratio", Quantity::Ignored, 1.0},
};

/// Beginnings of names that are left aside whole.
constexpr std::string_view kIgnoredPrefixes[] = {
    "header.",         "omega_iv_v_",     "f_v_",           "dtheta_v_", "dv_v_", "std_", "sd_", "sigma_",
    "position_sigma_", "velocity_sigma_", "attitude_sigma_"};

bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

TextColumns columns_named(std::initializer_list<std::string_view> names) {
  std::vector<TextColumn> columns;
  for (const std::string_view name : names) columns.push_back(column_named(name).value());
  return TextColumns(std::move(columns));
}

}  // namespace

TextColumns::TextColumns(std::vector<TextColumn> columns) : columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    auto& place = places_[static_cast<std::size_t>(columns_[i].quantity)];
    if (!place) place = i;
  }
}

std::optional<std::string> TextColumns::problem() const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Quantity quantity = columns_[i].quantity;
    if (quantity != Quantity::Ignored && find(quantity) != i) {
      return "has '" + columns_[i].name + "' beside '" + columns_[*find(quantity)].name + "'; expected each once";
    }
  }
  // All of a group or none of it.
  const auto partial = [this](std::initializer_list<Quantity> group) {
    const auto count = std::count_if(group.begin(), group.end(), [this](Quantity q) { return has(q); });
    return count != 0 && count != static_cast<std::ptrdiff_t>(group.size());
  };
  if (has(Quantity::Time) == has(Quantity::SecondOfWeek)) return "expected one column of time, such as t_s or sow_s";
  if (has(Quantity::GpsWeek) && !has(Quantity::SecondOfWeek)) return "has a week without seconds of week (sow_s)";
  if (!has(Quantity::Latitude) || !has(Quantity::Longitude) || !has(Quantity::Height)) {
    return "expected latitude, longitude and height, such as lat_deg, lon_deg and h_m";
  }
  if (partial({Quantity::VelocityNorth, Quantity::VelocityEast, Quantity::VelocityDown})) {
    return "expected all three components of the velocity or none, such as vn_mps, ve_mps, vd_mps";
  }
  if (partial({Quantity::Roll, Quantity::Pitch, Quantity::Yaw})) {
    return "expected all three angles or none, such as roll_deg, pitch_deg, yaw_deg";
  }
  if (partial({Quantity::QuaternionW, Quantity::QuaternionX, Quantity::QuaternionY, Quantity::QuaternionZ})) {
    return "expected all four components of q_nv or none";
  }
  if (has(Quantity::Roll) && has(Quantity::QuaternionW)) return "has angles beside q_nv; expected one of the two";
  return std::nullopt;
}

std::optional<TextColumn> column_named(std::string_view name) {
  const std::string plain = lower(name);
  for (const Spelling& spelling : kSpellings) {
    if (spelling.name == plain) return TextColumn{std::string(name), spelling.quantity, spelling.scale};
  }
  for (const std::string_view prefix : kIgnoredPrefixes) {
    if (begins_with(plain, prefix)) return TextColumn{std::string(name), Quantity::Ignored, 1.0};
  }
  return std::nullopt;
}

std::optional<TextColumns> columns_of_plain_text(std::size_t count) {
  switch (count) {
    case 11:
      return columns_named({"week", "sow_s", "lat_deg", "lon_deg", "h_m", "vn_mps", "ve_mps", "vd_mps", "roll_deg",
                            "pitch_deg", "yaw_deg"});
    case 7:
      return columns_named({"sow_s", "lat_deg", "lon_deg", "h_m", "std_n_m", "std_e_m", "std_d_m"});
    case 13:
      return columns_named({"sow_s", "lat_deg", "lon_deg", "h_m", "std_n_m", "std_e_m", "std_d_m", "vn_mps", "ve_mps",
                            "vd_mps", "std_vn_mps", "std_ve_mps", "std_vd_mps"});
    default:
      return std::nullopt;
  }
}

}  // namespace inslab::trajectory
