#pragma once

#include "inslab/data/json/json_file.hpp"
#include "inslab/foundation/fields/field.hpp"

namespace inslab::json {

namespace detail {

class JsonWriter {
 public:
  Json object = Json::object();
  bool with_wire_only = false;

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (field.is_wire_only && !with_wire_only) return;
    if constexpr (is_optional<T>) {
      if (value) object[std::string(field.name)] = convert(*value);
    } else {
      object[std::string(field.name)] = convert(value);
    }
  }

 private:
  template <class T>
  Json convert(const T& value) const {
    if constexpr (std::is_same_v<T, RunId>) {
      static constexpr char kHex[] = "0123456789abcdef";
      std::string text;
      for (const std::uint8_t byte : value.bytes) {
        text += kHex[byte >> 4];
        text += kHex[byte & 15];
      }
      return text;
    } else if constexpr (std::is_enum_v<T>) {
      return std::string(enum_name(value));
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      return Json::array({value.w(), value.x(), value.y(), value.z()});
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (is_list<T>) {
      Json list = Json::array();
      for (const auto& element : value) list.push_back(convert(element));
      return list;
    } else if constexpr (has_fields<T>) {
      JsonWriter nested;
      nested.with_wire_only = with_wire_only;
      T::fields(value, nested);
      return nested.object;
    } else {
      Json list = Json::array();
      for (Eigen::Index i = 0; i < value.size(); ++i) list.push_back(value[i]);
      return list;
    }
  }
};

}  // namespace detail

/// A struct as JSON, every field written out; reading it back gives the same struct to the bit.
template <class T>
Json json_from_struct(const T& value) {
  detail::JsonWriter writer;
  T::fields(value, writer);
  return writer.object;
}

/// As json_from_struct, with the fields that only travel on the wire (target, request, run id).
template <class T>
Json wire_to_json(const T& value) {
  detail::JsonWriter writer;
  writer.with_wire_only = true;
  T::fields(value, writer);
  return writer.object;
}

}  // namespace inslab::json
