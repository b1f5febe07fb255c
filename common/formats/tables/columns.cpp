#include "inslab/formats/tables/columns.hpp"

#include <array>
#include <utility>

namespace inslab::tables {
namespace {

using Suffix = std::pair<std::string_view, std::string_view>;

// A suffix that ends in another one stands before it.
constexpr std::array<Suffix, 18> kUnits{{{"_m_per_s_per_sqrt_h", "m/s/sqrt(h)"},
                                         {"_deg_per_sqrt_h", "deg/sqrt(h)"},
                                         {"_deg_per_h", "deg/h"},
                                         {"_deg_per_s", "deg/s"},
                                         {"_rad_per_s", "rad/s"},
                                         {"_m_per_s2", "m/s^2"},
                                         {"_m_per_s", "m/s"},
                                         {"_deg_c", "degC"},
                                         {"_arcsec", "arcsec"},
                                         {"_bytes", "byte"},
                                         {"_mgal", "mGal"},
                                         {"_ppm", "ppm"},
                                         {"_rad", "rad"},
                                         {"_deg", "deg"},
                                         {"_hz", "Hz"},
                                         {"_ns", "ns"},
                                         {"_m", "m"},
                                         {"_s", "s"}}};

bool ends_with(std::string_view text, std::string_view suffix) {
  return text.size() >= suffix.size() && text.substr(text.size() - suffix.size()) == suffix;
}

}  // namespace

std::string unit_of(std::string_view name) {
  while (!name.empty()) {
    for (const auto& [suffix, unit] : kUnits) {
      if (ends_with(name, suffix)) return std::string(unit);
    }
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) break;
    name = name.substr(0, dot);
  }
  return "1";
}

std::string to_hex(const RunId& run_id) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * run_id.bytes.size());
  for (const std::uint8_t byte : run_id.bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace inslab::tables
