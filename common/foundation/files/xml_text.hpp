#pragma once

#include <string>

#include "inslab/foundation/text/shown.hpp"

namespace inslab::files {

/// A text as it may stand in XML or HTML, in an attribute too; control characters and bytes that are not UTF-8 are
/// shown by their number.
inline std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text::shown_lines(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace inslab::files
