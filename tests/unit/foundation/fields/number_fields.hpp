#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

/// Walks the declarations of a struct, so that a test can touch every field without naming any.
namespace inslab::test {

/// Gives every field a value inside its limits: a fixed one in the lower half of the interval, one element in every
/// list, every optional present; or random ones, when there is an engine.
class ValidFiller {
 public:
  explicit ValidFiller(std::mt19937_64* engine = nullptr) : engine_(engine) {}

  template <class T>
  void operator()(const Field& field, T& value) {
    if constexpr (is_optional<T>) {
      if (engine_ == nullptr || (*engine_)() % 2 == 0) (*this)(field, value.emplace());
    } else if constexpr (std::is_same_v<T, bool>) {
      if (engine_ != nullptr) value = (*engine_)() % 2 == 0;
    } else if constexpr (std::is_enum_v<T>) {
      if (engine_ != nullptr) value = static_cast<T>((*engine_)() % EnumNames<T>::values.size());
    } else if constexpr (std::is_same_v<T, double>) {
      value = number(field);
    } else if constexpr (std::is_integral_v<T>) {
      if (std::isfinite(field.minimum)) {
        value = static_cast<T>(number(field));
      } else if (engine_ != nullptr) {
        value = static_cast<T>((*engine_)());
      }
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = text(field);
    } else if constexpr (is_list<T>) {
      value.assign(engine_ == nullptr ? 1 : (*engine_)() % (std::min<std::size_t>(field.max_size, 5) + 1), {});
      for (auto& element : value) (*this)(field, element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else if constexpr (!std::is_same_v<T, RunId>) {
      for (Eigen::Index i = 0; i < value.size(); ++i) value[i] = number(field);
    }
  }

 private:
  double number(const Field& field) {
    if (!std::isfinite(field.minimum)) return 1.0;
    if (engine_ == nullptr) return field.minimum + 0.3 * (field.maximum - field.minimum);
    // Both ends and zero are where a bit gets lost most easily.
    const std::uint64_t choice = (*engine_)() % 16;
    if (choice == 0) return field.minimum;
    if (choice == 1) return field.maximum;
    if (choice == 2 && field.minimum <= 0.0) return -0.0;
    return std::uniform_real_distribution<double>(field.minimum, field.maximum)(*engine_);
  }

  std::string text(const Field& field) {
    static const std::vector<std::string> kCharacters{"a", "Z", " ", "\"", "\\", "/", "é", "漢"};
    std::string out;
    if (engine_ == nullptr) return "text";
    const std::size_t wanted = (*engine_)() % (field.max_size + 1);
    while (out.size() + 3 <= wanted) out += kCharacters[(*engine_)() % kCharacters.size()];
    return out;
  }

  std::mt19937_64* engine_;
};

/// One number of a struct: where it is in JSON, how messages call it, and what it may be.
struct NumberField {
  std::string pointer;  ///< JSON pointer, such as "/imu/0/rate_hz"
  std::string path;     ///< such as "imu[0].rate_hz"
  double minimum = 0.0;
  double maximum = 0.0;
  bool is_whole = false;
  bool is_list_of_axes = false;  ///< stands for a whole vector, which one number may give
  double* value = nullptr;       ///< in the struct, when it is a double
};

/// Finds the numbers of a struct that outlives it.
class NumberFinder {
 public:
  explicit NumberFinder(bool with_wire_only = false) : with_wire_only_(with_wire_only) {}

  std::vector<NumberField> found;

  template <class T>
  void operator()(const Field& field, T& value) {
    if (field.is_wire_only && !with_wire_only_) return;
    find(field, pointer_ + "/" + std::string(field.name), path_ + (path_.empty() ? "" : ".") + std::string(field.name),
         value);
  }

 private:
  template <class T>
  void find(const Field& field, const std::string& pointer, const std::string& path, T& value) {
    if constexpr (is_optional<T>) {
      if (value) find(field, pointer, path, *value);
    } else if constexpr (std::is_same_v<T, double>) {
      found.push_back({pointer, path, field.minimum, field.maximum, false, false, &value});
    } else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> || std::is_same_v<T, std::string> ||
                         std::is_same_v<T, RunId>) {
      // Not numbers.
    } else if constexpr (std::is_integral_v<T>) {
      found.push_back({pointer, path, field.minimum, field.maximum, true, false, nullptr});
    } else if constexpr (is_list<T>) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        find(field, pointer + "/" + std::to_string(i), path + "[" + std::to_string(i) + "]", value[i]);
      }
    } else if constexpr (has_fields<T>) {
      NumberFinder nested(with_wire_only_);
      nested.pointer_ = pointer;
      nested.path_ = path;
      T::fields(value, nested);
      found.insert(found.end(), nested.found.begin(), nested.found.end());
    } else {
      found.push_back({pointer, path, field.minimum, field.maximum, false, true, nullptr});
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        found.push_back({pointer + "/" + std::to_string(i), path + "[" + std::to_string(i) + "]", field.minimum,
                         field.maximum, false, false, &value[i]});
      }
    }
  }

  bool with_wire_only_;
  std::string pointer_;
  std::string path_;
};

}  // namespace inslab::test
