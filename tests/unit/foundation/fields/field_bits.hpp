#pragma once

#include <cstring>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::test {

/// Everything a struct holds, as bits: two structs are the same when these are. Tells 0 from -0.
class FieldBits {
 public:
  std::vector<std::uint64_t> bits;

  template <class T>
  void operator()(const Field& field, const T& value) {
    if constexpr (is_optional<T>) {
      bits.push_back(value.has_value());
      if (value) (*this)(field, *value);
    } else if constexpr (std::is_same_v<T, double>) {
      add(value);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      bits.push_back(static_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      bits.push_back(value.size());
      for (const char c : value) bits.push_back(static_cast<unsigned char>(c));
    } else if constexpr (std::is_same_v<T, RunId>) {
      for (const std::uint8_t byte : value.bytes) bits.push_back(byte);
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      for (int i = 0; i < 4; ++i) add(value.coeffs()[i]);
    } else if constexpr (is_list<T>) {
      bits.push_back(value.size());
      for (const auto& element : value) (*this)(field, element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      for (Eigen::Index i = 0; i < value.size(); ++i) add(value[i]);
    }
  }

 private:
  void add(double value) {
    bits.push_back(0);
    std::memcpy(&bits.back(), &value, sizeof(value));
  }
};

template <class T>
std::vector<std::uint64_t> bits_of(const T& value) {
  FieldBits visitor;
  T::fields(value, visitor);
  return visitor.bits;
}

}  // namespace inslab::test
