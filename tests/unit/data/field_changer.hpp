#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::test {

/// Adds to the numbers of one field of a profile.
class FieldChanger {
 public:
  FieldChanger(std::string path, double by) : path_(std::move(path)), by_(by) {}

  template <class T>
  void operator()(const Field& field, T& value) {
    const std::string here = prefix_ + std::string(field.name);
    if constexpr (is_list<T>) {
      for (auto& element : value) within(here + "[].", element);
    } else if constexpr (has_fields<T>) {
      within(here + ".", value);
    } else if constexpr (std::is_same_v<T, double>) {
      if (here == path_) value += by_;
    } else if constexpr (std::is_enum_v<T>) {
      if (here == path_) value = static_cast<T>(1);
    } else if constexpr (!std::is_arithmetic_v<T> && !std::is_same_v<T, std::string>) {
      if (here == path_) value.array() += by_;
    }
  }

 private:
  template <class T>
  void within(const std::string& prefix, T& value) {
    const std::string outer = std::exchange(prefix_, prefix);
    T::fields(value, *this);
    prefix_ = outer;
  }

  std::string path_;
  double by_;
  std::string prefix_;
};

}  // namespace inslab::test
