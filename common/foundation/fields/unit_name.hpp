#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace inslab {
inline namespace samples {

/// What the name of a unit is made of, for messages.
inline constexpr const char* kUnitNameRule = "letters, digits, '_', '-' and '.', 64 at most";

/// Whether a unit may be called so. Its name is the DDS partition, and partitions match by pattern (fnmatch): of one
/// called '*' every command would go to every unit.
inline bool is_unit_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

}  // namespace samples
}  // namespace inslab
