#pragma once

#include <string>

#include "inslab/data/json/json_file.hpp"

namespace inslab::json {

/// A value as text, indented; bytes in its strings that are not UTF-8 become the replacement character.
inline std::string json_text(const Json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace inslab::json
