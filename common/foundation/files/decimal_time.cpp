#include "inslab/foundation/files/decimal_time.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::files {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> by_double(std::string_view text, std::int64_t unit_ns) {
  const auto number = number_from(text);
  if (!number || !(std::abs(*number * static_cast<double>(unit_ns)) < 9.2e18)) return std::nullopt;
  return std::llround(*number * static_cast<double>(unit_ns));
}

/// "1.7000000000100e+09", as NumPy writes by itself, without its exponent: "1700000000.0100". Empty: it has none, or
/// one that no time has.
std::string written_out(std::string_view text) {
  constexpr int kLargest = 30;
  const std::size_t mark = text.find_first_of("eE");
  if (mark == std::string_view::npos || text.find_first_of("0123456789") >= mark) return "";
  std::string_view power = text.substr(mark + 1);
  if (power.size() > 1 && power.front() == '+' && is_digit(power[1])) power.remove_prefix(1);
  int exponent = 0;
  const auto read = std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (read.ec != std::errc() || read.ptr != power.data() + power.size() || std::abs(exponent) > kLargest) return "";
  std::string digits(text.substr(0, mark));
  const std::size_t begin = digits.front() == '-' || digits.front() == '+' ? 1 : 0;
  std::size_t point = digits.find('.');
  if (point == std::string::npos) point = digits.size();
  if (point < digits.size()) digits.erase(point, 1);
  if (exponent < 0) {
    const auto back = static_cast<std::size_t>(-exponent);
    const std::size_t lacks = point - begin < back ? back - (point - begin) : 0;
    digits.insert(begin, lacks, '0');
    point = point + lacks - back;
  } else {
    point += static_cast<std::size_t>(exponent);
    if (point > digits.size()) digits.append(point - digits.size(), '0');
  }
  return digits.insert(point, 1, '.');
}

}  // namespace

std::optional<std::int64_t> exact_nanoseconds(std::string_view text, std::int64_t unit_ns) {
  __extension__ using Wide = __int128;  // GCC and Clang have it, the standard does not
  constexpr Wide kLargest = std::numeric_limits<std::int64_t>::max();
  const std::string plain = written_out(text);
  std::string_view rest = plain.empty() ? text : std::string_view(plain);
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
