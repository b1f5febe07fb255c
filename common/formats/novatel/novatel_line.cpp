#include "inslab/formats/novatel/novatel_line.hpp"

#include <zlib.h>

#include <array>
#include <cstdio>

#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::novatel {

std::uint32_t novatel_crc(std::string_view text) {
  // zlib's inverts its register before and after; inverting the two once more leaves the plain one.
  const auto crc = ::crc32(0xFFFFFFFFUL, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  return static_cast<std::uint32_t>(crc) ^ 0xFFFFFFFFU;
}

std::string crc_text(std::uint32_t crc) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08x", crc);
  return text.data();
}

std::optional<std::string> split_novatel(std::string_view text, NovatelLine& line) {
  text = files::trimmed(text);
  if (text.empty() || (text.front() != '#' && text.front() != '%')) return "does not begin with # or %";
  line.is_short = text.front() == '%';
  text.remove_prefix(1);
  if (const std::size_t star = text.rfind('*'); star != std::string_view::npos) {
    const auto given = files::hex_from(text.substr(star + 1));
    if (!given) return "ends in '" + std::string(text.substr(star).substr(0, 20)) + "'; expected * and a CRC";
    text = text.substr(0, star);
    const std::uint32_t computed = novatel_crc(text);
    if (*given != computed) return "has the CRC " + crc_text(*given) + "; expected " + crc_text(computed);
  }
  const std::size_t semicolon = text.find(';');
  if (semicolon == std::string_view::npos) return "has no ; between header and fields";
  files::split(text.substr(0, semicolon), ',', line.header);
  files::split(text.substr(semicolon + 1), ',', line.body);
  line.name = line.header.front();
  line.header.erase(line.header.begin());
  return std::nullopt;
}

}  // namespace inslab::novatel
