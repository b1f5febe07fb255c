#include "inslab/data/json/json_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/files_read.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::json {

namespace {

/// Builds the value that a text describes, in time and memory that grow with the text, and refuses what is deeper or
/// more than a file of ours can be, and a key given twice: nlohmann's own builders keep the last of two equal keys
/// without a word, copy what an object holds when it grows, and go through a list again with each of its elements.
class Builder {
 public:
  explicit Builder(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  Json result() { return std::move(root_); }

  // What the parser calls. False would end it; what is refused here throws.
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Json::number_integer_t value) { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // not in a text
  bool start_object(std::size_t) { return open(false); }
  bool start_array(std::size_t) { return open(true); }
  bool end_object() {
    Json::object_t object;
    object.reserve(open_.back().members.size());
    for (auto& [key, value] : open_.back().members) object.emplace_back(std::move(key), std::move(value));
    return close(std::move(object));
  }
  bool end_array() { return close(std::move(open_.back().elements)); }
  bool key(std::string& key) {
    Open& object = open_.back();
    object.key = key;
    if (!object.keys.insert(std::move(key)).second) fail(Rule::KeysOnce, path(), "the key is given twice");
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) {
    const std::size_t at = std::min(position, text_.size());
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    std::string what = error.what();
    const std::size_t detail = what.find("syntax error");
    // What comes before is the library's name for its exception.
    what.erase(0, detail != std::string::npos            ? detail
                  : what.find("] ") == std::string::npos ? 0
                                                         : what.find("] ") + 2);
    constexpr std::size_t kLongest = 300;
    if (what.size() > kLongest) what = text::cut(what, kLongest) + "...";
    fail(Rule::ValidJson, "line " + std::to_string(line), "not valid JSON: " + text::shown(what));
  }

 private:
  struct Open {
    bool is_list;
    std::string key;  ///< that came last
    std::set<std::string> keys;
    std::vector<std::pair<std::string, Json>> members;
    Json::array_t elements;
  };

  [[noreturn]] void fail(Rule rule, const std::string& path, const std::string& reason) const {
    throw Error(file_, {rule, path, reason});
  }

  void count_one() {
    if (++values_ <= files::kMaxJsonValues) return;
    fail(Rule::BoundedSize, path(),
         "is one value too many; expected at most " + std::to_string(files::kMaxJsonValues) + " in the whole file");
  }
  bool add(Json value) {
    count_one();
    put(std::move(value));
    return true;
  }
  bool open(bool is_list) {
    if (open_.size() == files::kMaxJsonLevels) {
      fail(Rule::BoundedSize, path(),
           "is nested deeper than " + std::to_string(files::kMaxJsonLevels) +
               " levels; expected lists and objects in each other up to that");
    }
    count_one();
    open_.push_back({is_list, {}, {}, {}, {}});
    return true;
  }
  template <class Container>
  bool close(Container&& container) {
    Json value(std::forward<Container>(container));
    open_.pop_back();
    put(std::move(value));
    return true;
  }
  void put(Json value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (open_.back().is_list) {
      open_.back().elements.push_back(std::move(value));
    } else {
      open_.back().members.emplace_back(open_.back().key, std::move(value));
    }
  }
  /// Of the value that comes next, or of the key that came last.
  std::string path() const {
    constexpr std::size_t kLongestKey = 60;
    std::string place;
    for (const Open& open : open_) {
      place += open.is_list ? "[" + std::to_string(open.elements.size()) + "]"
                            : (place.empty() ? "" : ".") + text::shown(text::cut(open.key, kLongestKey));
    }
    return place;
  }

  const std::string& file_;
  const std::string& text_;
  Json root_;
  std::vector<Open> open_;
  std::size_t values_ = 0;
};

/// Where a path that says no folder from the root on was looked for.
std::string looked_for(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return path.is_absolute() || error ? "" : "; it was looked for as " + whole.lexically_normal().string();
}

std::string too_large(std::uintmax_t bytes) {
  return "has " + std::to_string(bytes) + " bytes; expected at most " + std::to_string(files::kMaxJsonBytes);
}

}  // namespace

Json parse_json(const std::string& text, const std::string& file) {
  if (text.size() > files::kMaxJsonBytes) throw Error(file, {Rule::BoundedSize, "", too_large(text.size())});
  Builder builder(file, text);
  Json::sax_parse(text, &builder);
  return builder.result();
}

Json read_json_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  std::string reason;
  std::ostringstream text;
  if (!std::filesystem::exists(status)) {
    reason = error.message() + looked_for(path);
  } else if (!std::filesystem::is_regular_file(status)) {
    reason = "not a file";
  } else {
    errno = 0;
    files::note_file_read(path.string());
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (!error && bytes > files::kMaxJsonBytes) throw Error(path.string(), {Rule::BoundedSize, "", too_large(bytes)});
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

}  // namespace inslab::json
