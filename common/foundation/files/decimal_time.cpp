#include "inslab/foundation/files/decimal_time.hpp"

#include <cmath>
#include <limits>

#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::files {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> by_double(std::string_view text, std::int64_t unit_ns) {
  const auto number = number_from(text);
  if (!number || !(std::abs(*number * static_cast<double>(unit_ns)) < 9.2e18)) return std::nullopt;
  return std::llround(*number * static_cast<double>(unit_ns));
}

}  // namespace

std::optional<std::int64_t> exact_nanoseconds(std::string_view text, std::int64_t unit_ns) {
  __extension__ using Wide = __int128;  // GCC and Clang have it, the standard does not
  constexpr Wide kLargest = std::numeric_limits<std::int64_t>::max();
  std::string_view rest = text;
  const bool negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  Wide whole = 0, part = 0, part_unit = 1;
  std::size_t digits = 0;
  for (; !rest.empty() && is_digit(rest.front()); rest.remove_prefix(1), ++digits) {
    whole = whole * 10 + (rest.front() - '0');
    if (whole > kLargest) return std::nullopt;
  }
  if (!rest.empty() && rest.front() == '.') {
    rest.remove_prefix(1);
    for (; !rest.empty() && is_digit(rest.front()); rest.remove_prefix(1), ++digits) {
      constexpr Wide kFinest = 1'000'000'000'000'000'000;
      if (part_unit == kFinest) continue;
      part = part * 10 + (rest.front() - '0');
      part_unit *= 10;
    }
  }
  if (!rest.empty() || digits == 0) return by_double(text, unit_ns);
  const Wide ns = whole * unit_ns + (2 * part * unit_ns + part_unit) / (2 * part_unit);
  if (ns > kLargest) return std::nullopt;
  return static_cast<std::int64_t>(negative ? -ns : ns);
}

}  // namespace inslab::files
