#pragma once

#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::test {

/// Fills any struct that lists its fields with random values of the whole range of their types: what a file must keep.
class RandomFields {
 public:
  explicit RandomFields(std::uint64_t seed) : engine_(seed) {}

  template <class T>
  T make() {
    T value;
    T::fields(value, *this);
    return value;
  }

  template <class T>
  void operator()(const Field& field, T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      for (std::uint8_t& byte : value.bytes) byte = static_cast<std::uint8_t>(engine_());
    } else if constexpr (std::is_same_v<T, bool>) {
      value = engine_() % 2 == 0;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(engine_() % EnumNames<T>::values.size());
    } else if constexpr (std::is_integral_v<T>) {
      value = static_cast<T>(engine_());
    } else if constexpr (std::is_same_v<T, double>) {
      value = number();
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      value = Quaternion(number(), number(), number(), number());
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(engine_() % (field.max_size + 1));
      for (char& c : value) c = static_cast<char>(' ' + engine_() % 95);
    } else if constexpr (is_list<T>) {
      value.resize(engine_() % (field.max_size + 1));
      for (auto& element : value) (*this)(field, element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      for (Eigen::Index i = 0; i < value.size(); ++i) value[i] = number();
    }
  }

 private:
  double number() {
    switch (engine_() % 40) {
      case 0:
        return 0.0;
      case 1:
        return -0.0;
      case 2:
        return std::numeric_limits<double>::denorm_min();
      case 3:
        return -std::numeric_limits<double>::max();
      case 4:
        return std::numeric_limits<double>::infinity();
      case 5:
        return std::numeric_limits<double>::quiet_NaN();
      default:
        break;
    }
    // Any finite exponent and all 52 bits of the fraction.
    const std::uint64_t sign_and_fraction = engine_() & 0x800fffffffffffffULL;
    const std::uint64_t bits = sign_and_fraction | ((1 + engine_() % 2046) << 52);
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  std::mt19937_64 engine_;
};

}  // namespace inslab::test
