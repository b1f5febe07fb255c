#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "inslab/data/wire/cdr.hpp"

/// What a model must keep to go on after a restart, as bytes, bit for bit. Each class names its state once, for both
/// directions:
///
///   template <class Self, class Visitor>
///   static void state(Self& self, Visitor& visit) { visit(self.x, self.y); }
///
/// Bytes are those of this machine: a state is read again where it was written.
namespace inslab::state {

/// Thrown when bytes are not the state they are read as.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, RunId> ||
                                 std::is_same_v<T, Vector3> || std::is_same_v<T, Quaternion>;

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t n>
struct IsArray<std::array<T, n>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

template <class T>
struct IsVariant : std::false_type {};
template <class... T>
struct IsVariant<std::variant<T...>> : std::true_type {};

}  // namespace detail

/// Appends states to a buffer.
class StateWriter {
 public:
  explicit StateWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (detail::is_plain<T>) {
      bytes(&value, sizeof(value));
    } else if constexpr (detail::IsOptional<T>::value) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (detail::IsArray<T>::value) {
      for (const auto& element : value) put(element);
    } else if constexpr (detail::IsVector<T>::value) {
      put(static_cast<std::uint64_t>(value.size()));
      if constexpr (std::is_arithmetic_v<typename T::value_type>) {
        bytes(value.data(), value.size() * sizeof(value[0]));
      } else {
        for (const auto& element : value) put(element);
      }
    } else if constexpr (detail::IsVariant<T>::value) {
      put(static_cast<std::uint64_t>(value.index()));
      std::visit([this](const auto& alternative) { this->put(alternative); }, value);
    } else if constexpr (has_fields<T>) {
      wire::encode(value, encoded_);
      put(static_cast<std::uint64_t>(encoded_.size()));
      bytes(encoded_.data(), encoded_.size());
    } else {
      T::state(value, *this);
    }
  }

  void bytes(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    out_.insert(out_.end(), begin, begin + size);
  }

  std::vector<std::uint8_t>& out_;
  std::vector<std::uint8_t> encoded_;
};

/// Reads states in the order they were written. Throws StateError when the bytes end early or are no such value.
class StateReader {
 public:
  StateReader(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

  /// Throws StateError unless everything was read.
  void expect_end() const {
    if (at_ != end_) throw StateError(std::to_string(end_ - at_) + " bytes follow the state");
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (detail::is_plain<T>) {
      std::memcpy(static_cast<void*>(&value), take(sizeof(value)), sizeof(value));
    } else if constexpr (detail::IsOptional<T>::value) {
      bool present = false;
      get(present);
      value.reset();
      if (present) get(value.emplace());
    } else if constexpr (detail::IsArray<T>::value) {
      for (auto& element : value) get(element);
    } else if constexpr (detail::IsVector<T>::value) {
      value.clear();
      if constexpr (std::is_arithmetic_v<typename T::value_type>) {
        value.resize(length());
        for (auto& element : value) get(element);
      } else {
        for (std::uint64_t left = length(); left > 0; --left) get(value.emplace_back());
      }
    } else if constexpr (detail::IsVariant<T>::value) {
      get_variant(value, std::make_index_sequence<std::variant_size_v<T>>());
    } else if constexpr (has_fields<T>) {
      const std::uint64_t size = length();
      if (!wire::decode(take(size), size, value)) throw StateError("a sample in the state cannot be read");
    } else {
      T::state(value, *this);
    }
  }

  template <class T, std::size_t... i>
  void get_variant(T& value, std::index_sequence<i...>) {
    std::uint64_t index = 0;
    get(index);
    if (index >= sizeof...(i)) throw StateError("a state has no such alternative");
    ((index == i ? get(value.template emplace<i>()) : void()), ...);
  }

  /// Of a list or sample: no longer than what is left.
  std::uint64_t length() {
    std::uint64_t size = 0;
    get(size);
    if (size > static_cast<std::uint64_t>(end_ - at_)) throw StateError("a list in the state is too long");
    return size;
  }

  const std::uint8_t* take(std::size_t size) {
    if (size > static_cast<std::size_t>(end_ - at_)) throw StateError("the state ends early");
    return std::exchange(at_, at_ + size);
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

}  // namespace inslab::state
