#pragma once

#include <cstdint>

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// A satellite navigation system.
enum class GnssSystem : std::uint32_t { Gps, Glonass, Galileo, BeiDou, Qzss };

template <>
struct EnumNames<GnssSystem> {
  static constexpr std::string_view type = "GnssSystem";
  static constexpr std::string_view prefix = "GNSS_";
  static constexpr std::array<std::string_view, 5> values{"gps", "glonass", "galileo", "beidou", "qzss"};
};

/// How RINEX writes the systems, in the order of GnssSystem (RINEX 3.05, table 1).
inline constexpr std::string_view kSystemLetters = "GRECJ";

constexpr char letter_of(GnssSystem system) { return kSystemLetters[static_cast<std::size_t>(system)]; }

/// A satellite by its number in RINEX: the PRN, the slot of GLONASS, the PRN less 192 of QZSS.
struct SatelliteId {
  GnssSystem system = GnssSystem::Gps;
  std::uint8_t number = 0;

  friend bool operator==(const SatelliteId& a, const SatelliteId& b) {
    return a.system == b.system && a.number == b.number;
  }
  friend bool operator!=(const SatelliteId& a, const SatelliteId& b) { return !(a == b); }
  friend bool operator<(const SatelliteId& a, const SatelliteId& b) {
    return a.system != b.system ? a.system < b.system : a.number < b.number;
  }
};

/// The name in RINEX, such as G07.
inline std::string name_of(const SatelliteId& satellite) {
  const auto digit = [](int value) { return static_cast<char>('0' + value % 10); };
  return {letter_of(satellite.system), digit(satellite.number / 10), digit(satellite.number)};
}

/// BeiDou's satellites over the equator; other orbits and another message than its other satellites (B1I ICD 3.0, 5.1).
constexpr bool is_beidou_geostationary(const SatelliteId& satellite) {
  return satellite.system == GnssSystem::BeiDou && (satellite.number <= 5 || satellite.number >= 59);
}

}  // namespace samples
}  // namespace inslab
