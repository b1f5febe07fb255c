#pragma once

#include <cstring>
#include <optional>
#include <vector>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/text/shown.hpp"

/// XCDR1 (plain CDR) of the structs that list their fields. Little endian out, either endianness in. Source: OMG
/// DDS-RTPS 2.2 section 10 (encapsulation), CORBA 3.3 part 2 section 9.3 (CDR). The generated types of idl/ are the
/// independent proof: a test compares both byte for byte.
namespace inslab::wire {

inline constexpr std::size_t kEncapsulationSize = 4;

namespace detail {

/// Walks the fields and adds up the bytes; alignment counts from the end of the encapsulation header.
class SizeCounter {
 public:
  std::size_t size() const { return size_; }

  template <class T>
  void operator()(const Field&, const T& value) {
    add(value);
  }

 private:
  void primitive(std::size_t width) { size_ = (size_ + width - 1) / width * width + width; }
  void doubles(std::size_t count) { size_ = (size_ + 7) / 8 * 8 + 8 * count; }

  template <class T>
  void add(const T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      size_ += value.bytes.size();
    } else if constexpr (std::is_same_v<T, bool>) {
      size_ += 1;
    } else if constexpr (std::is_enum_v<T>) {
      primitive(4);
    } else if constexpr (std::is_arithmetic_v<T>) {
      primitive(sizeof(T));
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      doubles(4);
    } else if constexpr (std::is_same_v<T, std::string>) {
      primitive(4);
      size_ += value.size() + 1;
    } else if constexpr (is_list<T>) {
      primitive(4);
      for (const auto& element : value) add(element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      doubles(static_cast<std::size_t>(value.size()));
    }
  }

  std::size_t size_ = 0;
};

/// Writes the fields into a buffer known to be large enough.
class Encoder {
 public:
  explicit Encoder(std::uint8_t* body) : begin_(body), at_(body) {}

  template <class T>
  void operator()(const Field&, const T& value) {
    add(value);
  }

 private:
  void align(std::size_t width) {
    const std::size_t padding = (0 - static_cast<std::size_t>(at_ - begin_)) & (width - 1);
    std::memset(at_, 0, padding);
    at_ += padding;
  }
  template <class T>
  void put(T value) {
    align(sizeof(T));
    std::memcpy(at_, &value, sizeof(T));
    at_ += sizeof(T);
  }

  template <class T>
  void add(const T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      std::memcpy(at_, value.bytes.data(), value.bytes.size());
      at_ += value.bytes.size();
    } else if constexpr (std::is_same_v<T, bool>) {
      *at_++ = value ? 1 : 0;
    } else if constexpr (std::is_enum_v<T>) {
      put(static_cast<std::uint32_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      put(value);
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      put(value.w());
      put(value.x());
      put(value.y());
      put(value.z());
    } else if constexpr (std::is_same_v<T, std::string>) {
      put(static_cast<std::uint32_t>(value.size() + 1));
      std::memcpy(at_, value.c_str(), value.size() + 1);
      at_ += value.size() + 1;
    } else if constexpr (is_list<T>) {
      put(static_cast<std::uint32_t>(value.size()));
      for (const auto& element : value) add(element);
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      align(8);
      const std::size_t bytes = 8 * static_cast<std::size_t>(value.size());
      std::memcpy(at_, value.data(), bytes);
      at_ += bytes;
    }
  }

  std::uint8_t* begin_;
  std::uint8_t* at_;
};

/// Reads the fields out of bytes that anybody may have sent: every length and range is checked.
class Decoder {
 public:
  /// `without_inserted`: the bytes are of a version before the fields that were inserted since.
  Decoder(const std::uint8_t* body, std::size_t size, bool swap, bool without_inserted)
      : begin_(body), at_(body), end_(body + size), swap_(swap), without_inserted_(without_inserted) {}

  bool ok() const { return ok_; }
  bool is_at_the_end() const { return left() <= kMostPadding; }
  bool met_inserted() const { return met_inserted_; }

  template <class T>
  void operator()(const Field& field, T& value) {
    met_inserted_ = met_inserted_ || field.is_inserted;
    if (!ok_ || (field.is_appended && is_of_an_earlier_version()) || (field.is_inserted && without_inserted_)) return;
    get(field, value);
  }

 private:
  static constexpr std::size_t kMostPadding = 3;  ///< that some vendors put behind the last field

  /// Whether the bytes end where the first of the fields begins that came later.
  bool is_of_an_earlier_version() {
    if (!lacks_what_came_later_) lacks_what_came_later_ = is_at_the_end();
    return *lacks_what_came_later_;
  }

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  bool take(std::size_t width, std::size_t bytes) {
    const std::size_t offset = static_cast<std::size_t>(at_ - begin_) % width;
    const std::size_t padding = offset == 0 ? 0 : width - offset;
    ok_ = ok_ && padding <= left() && bytes <= left() - padding;
    if (ok_) at_ += padding;
    return ok_;
  }
  template <class T>
  void scalar(T& value) {
    if (!take(sizeof(T), sizeof(T))) return;
    std::uint8_t bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = at_[swap_ ? sizeof(T) - 1 - i : i];
    std::memcpy(&value, bytes, sizeof(T));
    at_ += sizeof(T);
  }

  template <class T>
  void get(const Field& field, T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      if (!take(1, value.bytes.size())) return;
      std::memcpy(value.bytes.data(), at_, value.bytes.size());
      at_ += value.bytes.size();
    } else if constexpr (std::is_same_v<T, bool>) {
      if (take(1, 1)) value = *at_++ != 0;
    } else if constexpr (std::is_enum_v<T>) {
      std::uint32_t number = 0;
      scalar(number);
      ok_ = ok_ && number < EnumNames<T>::values.size();
      if (ok_) value = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      scalar(value);
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      scalar(value.w());
      scalar(value.x());
      scalar(value.y());
      scalar(value.z());
    } else if constexpr (std::is_same_v<T, std::string>) {
      std::uint32_t length = 0;
      scalar(length);
      // The length counts the terminating NUL; some vendors send 0 for an empty string.
      if (!take(1, length)) return;
      const std::size_t characters = length == 0 ? 0 : length - 1;
      ok_ = characters <= field.max_size && (length == 0 || at_[characters] == 0);
      if (!ok_) return;
      value.assign(reinterpret_cast<const char*>(at_), characters);
      ok_ = text::is_plain(value);
      at_ += length;
    } else if constexpr (is_list<T>) {
      std::uint32_t count = 0;
      scalar(count);
      ok_ = ok_ && count <= field.max_size;
      if (!ok_) return;
      value.assign(count, {});
      for (auto& element : value) {
        if (ok_) get(field, element);
      }
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      for (int i = 0; i < value.size() && ok_; ++i) scalar(value[i]);
    }
  }

  const std::uint8_t* begin_;
  const std::uint8_t* at_;
  const std::uint8_t* end_;
  bool swap_;
  bool without_inserted_;
  bool met_inserted_ = false;
  bool ok_ = true;
  std::optional<bool> lacks_what_came_later_;
};

}  // namespace detail

/// Bytes that `encode` writes, encapsulation included.
template <class T>
std::size_t encoded_size(const T& value) {
  detail::SizeCounter counter;
  T::fields(value, counter);
  return kEncapsulationSize + counter.size();
}

/// Writes `value` into `out`, which holds at least encoded_size(value) bytes.
template <class T>
void encode_to(const T& value, std::uint8_t* out) {
  constexpr std::uint8_t kLittleEndianCdr[kEncapsulationSize] = {0x00, 0x01, 0x00, 0x00};
  std::memcpy(out, kLittleEndianCdr, kEncapsulationSize);
  detail::Encoder encoder(out + kEncapsulationSize);
  T::fields(value, encoder);
}

/// Replaces `out` by the CDR of `value`, encapsulation included.
template <class T>
void encode(const T& value, std::vector<std::uint8_t>& out) {
  out.resize(encoded_size(value));
  encode_to(value, out.data());
}

/// Reads `value` from a payload with its encapsulation header. False, with `value` in an unspecified valid state, when
/// the payload is not plain CDR, too short, holds an enumerator outside its enum, a string or list over its bound, or a
/// string that is not one line of UTF-8 (foundation/text/shown.hpp).
template <class T>
bool decode(const std::uint8_t* data, std::size_t size, T& value) {
  if (size < kEncapsulationSize || data[0] != 0x00 || data[1] > 0x01) return false;
  const bool little_endian = data[1] == 0x01;
  const auto decoder = [&](bool without_inserted) {
    return detail::Decoder(data + kEncapsulationSize, size - kEncapsulationSize, !little_endian, without_inserted);
  };
  detail::Decoder as_it_is = decoder(false);
  T::fields(value, as_it_is);
  if (as_it_is.ok() || !as_it_is.met_inserted()) return as_it_is.ok();
  // Of an earlier version the bytes end too soon; without what was inserted since they end where they should.
  value = T();
  detail::Decoder earlier = decoder(true);
  T::fields(value, earlier);
  return earlier.ok() && earlier.is_at_the_end();
}

}  // namespace inslab::wire
