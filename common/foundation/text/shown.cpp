#include "inslab/foundation/text/shown.hpp"

#include <cstdint>

namespace inslab::text {

namespace {

/// One character of a text: how many bytes it takes, and its number; 0 bytes of UTF-8 where a byte is none.
struct Character {
  std::size_t size = 1;
  std::uint32_t code = 0;
  bool is_utf8 = true;
};

/// By the table of well-formed byte sequences (The Unicode Standard, table 3-7): no surrogates, nothing longer than
/// needed, nothing above 10FFFF.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  std::uint32_t code = size == 4 ? lead & 0x07u : size == 3 ? lead & 0x0fu : lead & 0x1fu;
  bool is_utf8 = lead >= 0xc2 && lead <= 0xf4 && text.size() >= size;
  for (std::size_t i = 1; i < size && is_utf8; ++i) {
    is_utf8 = (byte(i) & 0xc0u) == 0x80;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  is_utf8 = is_utf8 && code >= kLeast[size] && code <= 0x10ffff && !(code >= 0xd800 && code <= 0xdfff);
  return is_utf8 ? Character{size, code, true} : Character{1, lead, false};
}

/// C0 and C1 controls, line and paragraph separators, and the marks that turn the direction of what follows.
bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x061c || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
}

std::string number_of(const Character& character) {
  constexpr char kDigits[] = "0123456789abcdef";
  const std::uint32_t code = character.code;
  if (!character.is_utf8 || code < 0x80) return {'\\', 'x', kDigits[code >> 4], kDigits[code & 15]};
  return {'\\', 'u', kDigits[code >> 12], kDigits[code >> 8 & 15], kDigits[code >> 4 & 15], kDigits[code & 15]};
}

std::string replaced(std::string_view text, bool keeps_lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_of(text);
    const bool is_kept_space = keeps_lines && (character.code == '\n' || character.code == '\t');
    if (character.is_utf8 && (is_kept_space || !is_control(character.code))) {
      out += text.substr(0, character.size);
    } else {
      out += number_of(character);
    }
    text.remove_prefix(character.size);
  }
  return out;
}

}  // namespace

std::string shown(std::string_view text) { return replaced(text, false); }

std::string shown_lines(std::string_view text) { return replaced(text, true); }

std::string quoted(std::string_view text, std::size_t most) {
  std::size_t end = 0;
  for (std::size_t count = 0; count < most && end < text.size(); ++count) end += first_of(text.substr(end)).size;
  return "'" + shown(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

std::string cut(std::string_view text, std::size_t most_bytes) {
  std::size_t end = 0;
  while (end < text.size()) {
    const std::size_t size = first_of(text.substr(end)).size;
    if (end + size > most_bytes) break;
    end += size;
  }
  return std::string(text.substr(0, end));
}

std::string file_name_of(std::string_view name) {
  constexpr std::string_view kSpecial = "/\\:*?\"<>|&;$`'!~#%{}[]()= ";
  std::string out;
  while (!name.empty()) {
    const Character character = first_of(name);
    const bool is_special = !character.is_utf8 || is_control(character.code) ||
                            (character.code < 0x80 && kSpecial.find(name.front()) != std::string_view::npos) ||
                            (out.empty() && (character.code == '.' || character.code == '-'));
    out += is_special ? std::string_view("_") : name.substr(0, character.size);
    name.remove_prefix(character.size);
  }
  return out.empty() ? "_" : out;
}

bool is_plain(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_of(text);
    if (!character.is_utf8 || is_control(character.code)) return false;
    text.remove_prefix(character.size);
  }
  return true;
}

}  // namespace inslab::text
