#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace inslab {
inline namespace samples {

namespace detail {

/// Bytes of the character that `text` begins with; 0 when that is none of UTF-8 (RFC 3629: no overlong form, no
/// surrogate, nothing above U+10FFFF) or a control character (C0, DEL, C1), which a terminal would obey.
inline std::size_t plain_character(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const auto follows = [&byte](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  if (first >= 0xC2 && first <= 0xDF) return follows(1, first == 0xC2 ? 0xA0 : 0x80) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    return follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    return follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace detail

/// Whether the text is one line of UTF-8: what JSON, logs and terminals take as it is.
inline bool is_plain_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = detail::plain_character(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

/// The text as one line of UTF-8 of at most `most` bytes, cut between two characters: a byte of anything else stands
/// there as \x1b. For what comes from files, errors and other participants before it is sent or shown.
inline std::string plain_text(std::string_view text, std::size_t most = std::string::npos) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string plain;
  while (!text.empty()) {
    const std::size_t bytes = detail::plain_character(text);
    const auto byte = static_cast<unsigned char>(text.front());
    const std::string next =
        bytes > 0 ? std::string(text.substr(0, bytes)) : std::string{'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    if (plain.size() + next.size() > most) break;
    plain += next;
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return plain;
}

}  // namespace samples
}  // namespace inslab
