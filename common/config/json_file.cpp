#include "config/json_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "config/error.hpp"

namespace inslab::config {

Json parse_json(const std::string& text, const std::string& file) {
  // nlohmann keeps the last of two equal keys without a word; a typo must not win silently.
  std::vector<std::set<std::string>> open_objects;
  const auto refuse_duplicates = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second) {
      throw Error(file, parsed.get<std::string>(), "the key is given twice");
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_duplicates);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min<std::size_t>(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const std::string what = error.what();
    const std::size_t detail = what.find("syntax error");
    throw Error(file, "line " + std::to_string(line),
                "not valid JSON: " + (detail == std::string::npos ? what : what.substr(detail)));
  } catch (const Json::out_of_range& error) {
    throw Error(file, "", std::string("not valid JSON: ") + error.what());
  }
}

Json read_json_file(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream && std::filesystem::is_regular_file(path)) text << stream.rdbuf();
  if (!stream || !std::filesystem::is_regular_file(path)) {
    throw Error(path.string(), "", std::string("cannot be read: ") + (errno ? std::strerror(errno) : "not a file"));
  }
  if (text.str().find_first_not_of(" \t\r\n") == std::string::npos) throw Error(path.string(), "", "is empty");
  return parse_json(text.str(), path.string());
}

std::string json_type_name(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null: return "null";
    case Json::value_t::object: return "an object";
    case Json::value_t::array: return "a list";
    case Json::value_t::string: return "a string";
    case Json::value_t::boolean: return "true or false";
    default: return "a number";
  }
}

}  // namespace inslab::config
