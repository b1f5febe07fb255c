#include "inslab/referee/montecarlo/part.hpp"

#include <cinttypes>
#include <cstdio>

namespace inslab::montecarlo {

std::optional<Part> part_of(const std::string& text, std::uint32_t runs) {
  if (text.empty()) return Part{0, runs};
  std::uint32_t k = 0, parts = 0;
  char rest = 0;
  const bool is_read = std::sscanf(text.c_str(), "%" SCNu32 "/%" SCNu32 "%c", &k, &parts, &rest) == 2;
  if (!is_read || text.find_first_not_of("0123456789/") != std::string::npos || k < 1 || k > parts) return std::nullopt;
  const auto bound = [&](std::uint64_t i) { return static_cast<std::uint32_t>(runs * i / parts); };
  return Part{bound(k - 1), bound(k)};
}

}  // namespace inslab::montecarlo
