#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace inslab::json {

using Json = nlohmann::ordered_json;

/// Parses `text`. Throws Error naming `file`, with line and column for syntax errors (NaN and Infinity are such), and
/// the key for a key given twice.
Json parse_json(const std::string& text, const std::string& file);

/// Reads and parses a file. Throws Error when it cannot be read.
Json read_json_file(const std::filesystem::path& path);

/// The name of a JSON value's type for messages: "a number", "a string", ...
std::string json_type_name(const Json& value);

}  // namespace inslab::json
