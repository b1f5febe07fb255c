#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace inslab::trajectory {

/// What a column of a trajectory text may hold; the values in SI units and radians.
enum class Quantity : std::size_t {
  Time,          ///< s, from any zero
  GpsWeek,       ///< full week
  SecondOfWeek,  ///< s
  Latitude,
  Longitude,
  Height,  ///< above the ellipsoid
  VelocityNorth,
  VelocityEast,
  VelocityDown,
  Roll,
  Pitch,
  Yaw,
  QuaternionW,  ///< of q_nv
  QuaternionX,
  QuaternionY,
  QuaternionZ,
  Ignored,  ///< known, and not needed: standard deviations, the other columns of our own truth
};

inline constexpr std::size_t kQuantities = static_cast<std::size_t>(Quantity::Ignored) + 1;

/// One column: what it holds, and by what its numbers are multiplied.
struct TextColumn {
  std::string name;
  Quantity quantity = Quantity::Ignored;
  double scale = 1.0;
};

/// The columns of a text, and where each quantity stands.
class TextColumns {
 public:
  TextColumns() = default;
  explicit TextColumns(std::vector<TextColumn> columns);

  std::size_t size() const { return columns_.size(); }
  const TextColumn& operator[](std::size_t index) const { return columns_[index]; }
  /// The column of a quantity; kQuantities columns at most, so this is a look-up.
  std::optional<std::size_t> find(Quantity quantity) const { return places_[static_cast<std::size_t>(quantity)]; }
  bool has(Quantity quantity) const { return find(quantity).has_value(); }
  bool has_velocity() const { return has(Quantity::VelocityNorth); }
  bool has_attitude() const { return has(Quantity::Roll) || has(Quantity::QuaternionW); }

  /// Why a trajectory cannot be read from these, such as "has no longitude; ..."; nothing when it can.
  std::optional<std::string> problem() const;

 private:
  std::vector<TextColumn> columns_;
  std::array<std::optional<std::size_t>, kQuantities> places_;
};

/// The column that a name stands for (docs/formats.md lists them: lat_deg, latitude_rad, vn_mps, v_n_m_per_s.x, ...);
/// nothing when the name is not known.
std::optional<TextColumn> column_named(std::string_view name);

/// The columns of a text without names, by their number: 11, the .nav text; 7 and 13, GNSS positions without and with
/// velocity. Nothing for another number.
std::optional<TextColumns> columns_of_plain_text(std::size_t count);

}  // namespace inslab::trajectory
