#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace inslab::novatel {

/// NovAtel's 32-bit CRC of what stands between the first character of a message (# or %) and its asterisk, neither
/// included: the reflected polynomial 0xEDB88320 from 0, without a final inversion (OEM7 manual, "32-bit CRC").
std::uint32_t novatel_crc(std::string_view text);

/// A CRC as it stands in a message: 8 lower-case hexadecimal digits.
std::string crc_text(std::uint32_t crc);

/// An ASCII message taken apart: "%NAME,header...;body...*crc", or with # and the long header.
struct NovatelLine {
  std::string_view name;
  std::vector<std::string_view> header;  ///< after the name
  std::vector<std::string_view> body;
  bool is_short = false;  ///< began with %
};

/// Takes a line apart; the views live as long as `text`. Returns why it cannot, such as "has the CRC ffffffff; expected
/// a5db8c7b"; a line without a CRC is taken as it is.
std::optional<std::string> split_novatel(std::string_view text, NovatelLine& line);

}  // namespace inslab::novatel
