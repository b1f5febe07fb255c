#pragma once

#include <algorithm>

#include "inslab/data/json/config_error.hpp"
#include "inslab/data/json/json_file.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/text/nearest.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::json {

namespace detail {

/// The known key that `key` was most likely meant to be; empty when there is none: a key is a quantity and its unit, so
/// a letter or two wrong come first, then another unit.
std::string nearest_key(const std::string& key, const std::vector<std::string>& known);

/// Reads one JSON object into one struct: every key known, every value of the right type and inside its limits.
class JsonReader {
 public:
  JsonReader(const Json& object, std::string file, std::string path)
      : object_(object), file_(std::move(file)), path_(std::move(path)) {
    if (!object.is_object()) wrong_type(path_, object, "an object");
  }

  template <class T>
  void operator()(const Field& field, T& value) {
    if (field.is_wire_only) return;
    const std::string key(field.name);
    known_.push_back(key);
    const auto found = object_.find(key);
    if (found != object_.end()) {
      read(field, child(key), *found, value);
    } else if (field.is_required) {
      missing_.push_back(key);
    }
  }

  /// Call after all fields were visited. A misspelt key comes before a missing one, which it most often is; one that
  /// resembles none comes last, since a missing type can make every other key unknown.
  void finish() const {
    std::string strange;
    for (const auto& item : object_.items()) {
      if (is_schema(item.key(), item.value())) continue;
      if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
      const std::string nearest = nearest_key(item.key(), known_);
      if (!nearest.empty()) {
        fail(Rule::KnownKey, child(item.key()), "unknown key; did you mean '" + nearest + "'?");
      }
      if (strange.empty()) strange = item.key();
    }
    if (!missing_.empty()) fail(Rule::RequiredKey, child(missing_.front()), "missing");
    if (!strange.empty()) fail(Rule::KnownKey, child(strange), "unknown key; expected one of: " + joined(known_));
  }

 private:
  /// "$schema" at the top of a file is for editors.
  bool is_schema(const std::string& key, const Json& value) const {
    if (key != "$schema" || !path_.empty()) return false;
    if (!value.is_string()) wrong_type(key, value, "a string");
    return true;
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  std::string child(const std::string& key) const {
    constexpr std::size_t kLongestKey = 60;
    return (path_.empty() ? "" : path_ + ".") + text::shown(text::cut(key, kLongestKey));
  }

  [[noreturn]] void fail(Rule rule, const std::string& path, const std::string& reason) const {
    throw Error(file_, {rule, path, reason});
  }
  [[noreturn]] void wrong_type(const std::string& path, const Json& json, const std::string& expected) const {
    fail(Rule::ValueType, path, "is " + json_type_name(json) + "; expected " + expected);
  }

  double number(const Field& field, const std::string& path, const Json& json) const {
    if (!json.is_number()) wrong_type(path, json, "a number");
    const double value = json.get<double>();
    if (!(std::isfinite(value) && value >= field.minimum && value <= field.maximum)) {
      fail(Rule::ValueRange, path, inslab::samples::detail::limit_reason(value, field));
    }
    return value;
  }

  template <class T>
  void read_integer(const Field& field, const std::string& path, const Json& json, T& value) const {
    if (!json.is_number_integer()) wrong_type(path, json, "a whole number");
    number(field, path, json);
    if (std::is_unsigned_v<T> && !json.is_number_unsigned() && json.get<std::int64_t>() < 0) {
      fail(Rule::ValueRange, path, "is " + json.dump() + "; expected 0 or above");
    }
    if (json.is_number_unsigned()) {
      const auto raw = json.get<std::uint64_t>();
      if (raw > static_cast<std::uint64_t>(std::numeric_limits<T>::max())) fail(Rule::ValueRange, path, "is too large");
      value = static_cast<T>(raw);
    } else {
      value = static_cast<T>(json.get<std::int64_t>());
    }
  }

  template <class Enum>
  void read_enum(const std::string& path, const Json& json, Enum& value) const {
    const auto& names = EnumNames<Enum>::values;
    std::vector<std::string> known(names.begin(), names.end());
    if constexpr (enum_has_numbers<Enum>) {
      if (json.is_number_integer()) {
        if (const auto numbered = enum_of_number<Enum>(json.get<std::int64_t>())) {
          value = *numbered;
          return;
        }
        for (const auto number : EnumNames<Enum>::numbers) known.push_back(std::to_string(number));
        fail(Rule::KnownName, path, "is " + json.dump() + "; expected one of: " + joined(known));
      }
    }
    if (!json.is_string()) wrong_type(path, json, "a string");
    const auto word = json.get<std::string>();
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      fail(Rule::KnownName, path,
           "is " + text::quoted(word) + "; expected one of: " + joined(known) + text::did_you_mean(word, known));
    }
    value = static_cast<Enum>(found - names.begin());
  }

  template <class T>
  void read_array(const Field& field, const std::string& path, const Json& json, T& value) const {
    if (json.is_number()) {
      value.setConstant(number(field, path, json));
      return;
    }
    const auto size = static_cast<std::size_t>(value.size());
    if (!json.is_array() || json.size() != size) {
      fail(Rule::ValueType, path,
           "is " + json_type_name(json) + (json.is_array() ? " of " + std::to_string(json.size()) : "") +
               "; expected a number or a list of " + std::to_string(size));
    }
    for (std::size_t i = 0; i < size; ++i) {
      value[static_cast<Eigen::Index>(i)] = number(field, path + "[" + std::to_string(i) + "]", json[i]);
    }
  }

  template <class T>
  void read(const Field& field, const std::string& path, const Json& json, T& value) const {
    if constexpr (is_optional<T>) {
      typename T::value_type present{};
      read(field, path, json, present);
      value = std::move(present);
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!json.is_boolean()) wrong_type(path, json, "true or false");
      value = json.get<bool>();
    } else if constexpr (std::is_enum_v<T>) {
      read_enum(path, json, value);
    } else if constexpr (std::is_same_v<T, double>) {
      value = number(field, path, json);
    } else if constexpr (std::is_integral_v<T>) {
      read_integer(field, path, json, value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!json.is_string()) wrong_type(path, json, "a string");
      value = json.get<std::string>();
      if (value.size() > field.max_size) {
        fail(Rule::BoundedSize, path,
             "has " + std::to_string(value.size()) + " characters; expected at most " + std::to_string(field.max_size));
      }
      if (!text::is_plain(value)) {
        fail(Rule::PlainText, path, "is '" + text::shown(value) + "'; expected one line without control characters");
      }
    } else if constexpr (is_list<T>) {
      if (!json.is_array()) wrong_type(path, json, "a list");
      if (json.size() > field.max_size) {
        fail(Rule::BoundedSize, path,
             "has " + std::to_string(json.size()) + " elements; expected at most " + std::to_string(field.max_size));
      }
      value.assign(json.size(), {});
      for (std::size_t i = 0; i < json.size(); ++i)
        read(field, path + "[" + std::to_string(i) + "]", json[i], value[i]);
    } else if constexpr (has_fields<T>) {
      JsonReader nested(json, file_, path);
      T::fields(value, nested);
      nested.finish();
    } else {
      read_array(field, path, json, value);
    }
  }

  const Json& object_;
  std::string file_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::string> missing_;
};

}  // namespace detail

/// Reads a struct from JSON; `file` is for messages. Absent keys that are not required keep the struct's defaults.
/// Throws Error naming file and JSON path for an unknown or missing key, a wrong type, or a value outside its limits.
template <class T>
T struct_from_json(const Json& json, const std::string& file) {
  T value;
  detail::JsonReader reader(json, file, "");
  T::fields(value, reader);
  reader.finish();
  return value;
}

/// Reads a struct from a JSON file. Throws Error as `struct_from_json` and `read_json_file` do.
template <class T>
T read_file(const std::filesystem::path& path) {
  return struct_from_json<T>(read_json_file(path), path.string());
}

}  // namespace inslab::json
