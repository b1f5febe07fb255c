#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace inslab::files {

/// The nanoseconds that a decimal number of units makes, a unit being `unit_ns` long (10^9: seconds), rounded once. The
/// number is never a double on the way: Unix seconds in a double have steps of 240 ns, which at 30 m/s and 100 Hz shake
/// a trajectory by 0.1 m/s^2. Nothing when the text is no number or lies beyond 292 years.
std::optional<std::int64_t> exact_nanoseconds(std::string_view text, std::int64_t unit_ns);

}  // namespace inslab::files
