#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"

namespace inslab {
inline namespace samples {

/// The shortest text that gives the number back, so that 1000.0001 is not refused as 1000.
inline std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

namespace detail {

/// "is 7; expected 0 to 5 (deg/h)" in the one wording that files, requests and tests share.
inline std::string limit_reason(double value, const Field& field) {
  const bool unlimited = !std::isfinite(field.minimum) && !std::isfinite(field.maximum);
  return "is " + number_text(value) + "; expected " +
         (unlimited ? "a finite number" : number_text(field.minimum) + " to " + number_text(field.maximum));
}

class LimitChecker {
 public:
  std::optional<Violation> found;

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (!found) check(field, std::string(field.name), value);
  }

 private:
  void number(const Field& field, const std::string& path, double value) {
    if (!found && !(std::isfinite(value) && value >= field.minimum && value <= field.maximum)) {
      found = Violation{Rule::ValueRange, path, limit_reason(value, field)};
    }
  }

  template <class T>
  void check(const Field& field, const std::string& path, const T& value) {
    if constexpr (is_optional<T>) {
      if (value) check(field, path, *value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (value.size() > field.max_size) {
        found = Violation{
            Rule::BoundedSize, path,
            "has " + std::to_string(value.size()) + " characters; expected at most " + std::to_string(field.max_size)};
      }
    } else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> || std::is_same_v<T, RunId>) {
      // Every value of these is admissible.
    } else if constexpr (std::is_arithmetic_v<T>) {
      number(field, path, static_cast<double>(value));
    } else if constexpr (is_list<T>) {
      if (value.size() > field.max_size) {
        found = Violation{
            Rule::BoundedSize, path,
            "has " + std::to_string(value.size()) + " elements; expected at most " + std::to_string(field.max_size)};
      }
      for (std::size_t i = 0; i < value.size() && !found; ++i) {
        check(field, path + "[" + std::to_string(i) + "]", value[i]);
      }
    } else if constexpr (has_fields<T>) {
      LimitChecker nested;
      T::fields(value, nested);
      if (nested.found) found = Violation{nested.found->rule, path + "." + nested.found->path, nested.found->reason};
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      for (int i = 0; i < 4; ++i) number(field, path, value.coeffs()[i]);
    } else {
      for (int i = 0; i < value.size(); ++i) number(field, path + "[" + std::to_string(i) + "]", value[i]);
    }
  }
};

}  // namespace detail

/// The first field of `value` that is not finite, outside its limits or over its bound.
template <class T>
std::optional<Violation> limit_violation(const T& value) {
  samples::detail::LimitChecker checker;
  T::fields(value, checker);
  return checker.found;
}

}  // namespace samples
}  // namespace inslab
