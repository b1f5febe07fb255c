#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::files {

/// Takes little-endian numbers and length-prefixed strings out of bytes that anybody may have written. Every step is
/// checked; what does not fit throws ReadError with the place in the file.
class ByteReader {
 public:
  /// `data` lies at `file_offset` of the file `path` (of which a reference is kept).
  ByteReader(const std::string& path, std::uint64_t file_offset, const std::uint8_t* data, std::size_t size)
      : path_(path), file_offset_(file_offset), data_(data), size_(size) {}

  std::size_t left() const { return size_ - at_; }
  std::size_t position() const { return at_; }
  std::uint64_t file_offset() const { return file_offset_ + at_; }
  const std::string& path() const { return path_; }

  template <class T>
  T number(const char* what) {
    static_assert(std::is_unsigned_v<T>);
    const std::uint8_t* bytes = take(sizeof(T), what);
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value | static_cast<T>(T{bytes[i]} << (8 * i)));
    return value;
  }
  std::string text(const char* what) {
    const auto size = number<std::uint32_t>(what);
    const std::uint8_t* bytes = take(size, what);
    return std::string(reinterpret_cast<const char*>(bytes), size);
  }
  /// A block with a 4-byte length before it.
  ByteReader block(const char* what) {
    const auto size = number<std::uint32_t>(what);
    const std::uint64_t begin = file_offset();
    return ByteReader(path_, begin, take(size, what), size);
  }
  std::map<std::string, std::string> text_map(const char* what) {
    std::map<std::string, std::string> map;
    ByteReader pairs = block(what);
    while (pairs.left() > 0) {
      std::string key = pairs.text(what);
      map[std::move(key)] = pairs.text(what);
    }
    return map;
  }
  const std::uint8_t* take(std::uint64_t size, const char* what) {
    if (size > left()) {
      throw ReadError(path_, file_offset(),
                      std::to_string(size) + " bytes of " + what + ", found " + std::to_string(left()));
    }
    const std::uint8_t* begin = data_ + at_;
    at_ += static_cast<std::size_t>(size);
    return begin;
  }

 private:
  const std::string& path_;
  std::uint64_t file_offset_;
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace inslab::files
