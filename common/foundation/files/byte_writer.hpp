#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace inslab::files {

using Bytes = std::vector<std::uint8_t>;

/// Appends little-endian numbers and length-prefixed strings to a buffer.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  template <class T>
  void number(T value) {
    static_assert(std::is_unsigned_v<T>);
    std::uint8_t bytes[sizeof(T)];
    store(bytes, value);
    out_.insert(out_.end(), bytes, bytes + sizeof(T));
  }
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    out_.insert(out_.end(), value.begin(), value.end());
  }
  template <class Map>
  void text_map(const Map& map) {
    const std::size_t at = begin_block();
    for (const auto& [key, value] : map) {
      text(key);
      text(value);
    }
    end_block(at);
  }

  /// A block with a 4-byte length before it, which end_block() fills in.
  std::size_t begin_block() {
    number(std::uint32_t{0});
    return out_.size();
  }
  void end_block(std::size_t begin) { store(out_.data() + begin - 4, static_cast<std::uint32_t>(out_.size() - begin)); }

  /// A record with its opcode and 8-byte length, which end_record() fills in.
  std::size_t begin_record(std::uint8_t opcode) {
    number(opcode);
    number(std::uint64_t{0});
    return out_.size();
  }
  void end_record(std::size_t begin) {
    store(out_.data() + begin - 8, static_cast<std::uint64_t>(out_.size() - begin));
  }

  template <class T>
  static void store(std::uint8_t* at, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * i));
  }

 private:
  std::vector<std::uint8_t>& out_;
};

}  // namespace inslab::files
