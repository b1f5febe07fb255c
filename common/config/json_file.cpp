#include "config/json_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "config/error.hpp"
#include "config/files_read.hpp"

namespace inslab::config {

namespace {

/// Follows the parser and finds a key given twice: nlohmann keeps the last of two equal keys without a word, and a typo
/// must not win silently.
class KeyWatch {
 public:
  /// The path of the key when the object that is open has it already.
  std::optional<std::string> follow(Json::parse_event_t event, const Json& parsed) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        begin_element();
        open_.push_back({event == Json::parse_event_t::array_start, 0, {}, {}});
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case Json::parse_event_t::value:
        begin_element();
        break;
      case Json::parse_event_t::key:
        open_.back().key = parsed.get<std::string>();
        if (!open_.back().keys.insert(open_.back().key).second) return path();
        break;
    }
    return std::nullopt;
  }

 private:
  struct Open {
    bool is_list;
    std::size_t elements;
    std::string key;
    std::set<std::string> keys;
  };

  void begin_element() {
    if (!open_.empty() && open_.back().is_list) ++open_.back().elements;
  }
  std::string path() const {
    std::string text;
    for (const Open& open : open_) {
      text += open.is_list ? "[" + std::to_string(open.elements - 1) + "]" : (text.empty() ? "" : ".") + open.key;
    }
    return text;
  }

  std::vector<Open> open_;
};

}  // namespace

Json parse_json(const std::string& text, const std::string& file) {
  KeyWatch watch;
  const auto refuse_duplicates = [&](int, Json::parse_event_t event, Json& parsed) {
    if (const auto twice = watch.follow(event, parsed)) {
      throw Error(file, {Rule::KeysOnce, *twice, "the key is given twice"});
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
    throw Error(file, {Rule::ValidJson, "line " + std::to_string(line),
                       "not valid JSON: " + (detail == std::string::npos ? what : what.substr(detail))});
  } catch (const Json::out_of_range& error) {
    throw Error(file, {Rule::ValidJson, "", std::string("not valid JSON: ") + error.what()});
  }
}

Json read_json_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  std::string reason;
  std::ostringstream text;
  if (!std::filesystem::exists(status)) {
    reason = error.message();
  } else if (!std::filesystem::is_regular_file(status)) {
    reason = "not a file";
  } else {
    errno = 0;
    note_file_read(path.string());
    std::ifstream stream(path, std::ios::binary);
    // An empty file sets the fail bit of `text`, not of `stream`.
    if (stream) text << stream.rdbuf();
    if (!stream) reason = std::strerror(errno);
  }
  if (!reason.empty()) {
    throw Error(path.string(), {Rule::Readable, "", "cannot be read: " + reason});
  }
  if (text.str().find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(path.string(), {Rule::NotEmpty, "", "is empty"});
  return parse_json(text.str(), path.string());
}

std::string json_type_name(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::string:
      return "a string";
    case Json::value_t::boolean:
      return "true or false";
    default:
      return "a number";
  }
}

}  // namespace inslab::config
