#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace inslab::montecarlo {

/// Runs `first` to `end` - 1 of a study.
struct Part {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// "K/T": part K of T, as equal as they can be; of an empty text all runs. Nothing when it is no such text.
std::optional<Part> part_of(const std::string& text, std::uint32_t runs);

}  // namespace inslab::montecarlo
