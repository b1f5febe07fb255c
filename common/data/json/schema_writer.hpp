#pragma once

#include <algorithm>
#include <utility>

#include "inslab/data/json/json_file.hpp"
#include "inslab/foundation/fields/field.hpp"

namespace inslab::json {

namespace detail {

template <class T, class = void>
struct HasDiscriminator : std::false_type {};
template <class T>
struct HasDiscriminator<T, std::enable_if_t<T::has_discriminator>> : std::true_type {};

/// The schema of a struct; of one whose fields depend on its first, an enum, one alternative for each enumerator.
template <class T>
Json schema_of_struct();

class SchemaWriter {
 public:
  Json properties = Json::object();
  Json required = Json::array();

  template <class T>
  void operator()(const Field& field, T& value) {
    if (field.is_wire_only) return;
    const std::string key(field.name);
    properties[key] = schema_of(field, value);
    if (!field.meaning.empty()) properties[key]["description"] = std::string(field.meaning);
    if (field.is_required) required.push_back(key);
  }

 private:
  static void add_limits(const Field& field, Json& schema) {
    if (std::isfinite(field.minimum)) schema["minimum"] = field.minimum;
    if (std::isfinite(field.maximum)) schema["maximum"] = field.maximum;
  }
  static Json number(const Field& field) {
    Json schema{{"type", "number"}};
    add_limits(field, schema);
    return schema;
  }

  template <class T>
  static Json schema_of(const Field& field, const T& value) {
    if constexpr (is_optional<T>) {
      Json schema = schema_of(field, typename T::value_type{});
      schema.erase("default");
      return schema;
    } else if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}, {"default", value}};
    } else if constexpr (std::is_enum_v<T>) {
      Json schema{{"enum", Json::array()}};
      for (const std::string_view name : EnumNames<T>::values) schema["enum"].push_back(std::string(name));
      if constexpr (enum_has_numbers<T>) {
        for (const auto number : EnumNames<T>::numbers) schema["enum"].push_back(number);
      }
      if (!field.is_required) schema["default"] = std::string(enum_name(value));
      return schema;
    } else if constexpr (std::is_same_v<T, double>) {
      Json schema = number(field);
      if (!field.is_required) schema["default"] = value;
      return schema;
    } else if constexpr (std::is_integral_v<T>) {
      Json schema{{"type", "integer"}};
      add_limits(field, schema);
      if (std::is_unsigned_v<T> && !schema.contains("minimum")) schema["minimum"] = 0;
      if (!field.is_required) schema["default"] = value;
      return schema;
    } else if constexpr (std::is_same_v<T, std::string>) {
      return {{"type", "string"}, {"maxLength", field.max_size}};
    } else if constexpr (is_list<T>) {
      typename T::value_type element{};
      return {{"type", "array"}, {"maxItems", field.max_size}, {"items", schema_of(Field(""), element)}};
    } else if constexpr (has_fields<T>) {
      return schema_of_struct<T>();
    } else {
      const auto size = static_cast<std::size_t>(value.size());
      const Json list{{"type", "array"}, {"items", number(field)}, {"minItems", size}, {"maxItems", size}};
      Json initial = Json::array();
      for (Eigen::Index i = 0; i < value.size(); ++i) initial.push_back(value[i]);
      Json schema{{"anyOf", Json::array({number(field), list})}};
      if (!field.is_required) schema["default"] = value.isConstant(value[0], 0.0) ? initial[0] : initial;
      return schema;
    }
  }
};

template <class T>
Json schema_of_fields(T& value) {
  SchemaWriter writer;
  T::fields(value, writer);
  Json schema{{"type", "object"}, {"properties", writer.properties}, {"additionalProperties", false}};
  if (!writer.required.empty()) schema["required"] = writer.required;
  return schema;
}

/// Sets the first enum field: the discriminator.
struct DiscriminatorSetter {
  std::size_t index;
  std::string key;
  std::size_t alternatives = 0;
  std::string value_name;
  std::optional<std::uint32_t> value_number;
  bool may_be_absent = false;  ///< what is meant then is this alternative

  template <class T>
  void operator()(const Field& field, T& value) {
    if constexpr (std::is_enum_v<T>) {
      if (!key.empty()) return;
      key = field.name;
      may_be_absent = !field.is_required && static_cast<std::size_t>(value) == index;
      alternatives = EnumNames<T>::values.size();
      value = static_cast<T>(index);
      value_name = enum_name(value);
      value_number = enum_number(value);
    }
  }
};

template <class T>
Json schema_of_struct() {
  if constexpr (HasDiscriminator<T>::value) {
    Json alternatives = Json::array();
    for (std::size_t i = 0, count = 1; i < count; ++i) {
      T value;
      DiscriminatorSetter setter{i, {}, 0, {}, {}, false};
      T::fields(value, setter);
      count = setter.alternatives;
      Json schema = schema_of_fields(value);
      Json fixed = Json::object();
      if (setter.value_number) {
        fixed["enum"] = Json::array({setter.value_name, *setter.value_number});
      } else {
        fixed["const"] = setter.value_name;
      }
      schema["properties"][setter.key] = std::move(fixed);
      Json& required = schema["required"];
      if (!setter.may_be_absent && std::find(required.begin(), required.end(), setter.key) == required.end()) {
        required.push_back(setter.key);
      }
      if (required.empty()) schema.erase("required");
      alternatives.push_back(std::move(schema));
    }
    Json schema = Json::object();
    schema["oneOf"] = std::move(alternatives);
    return schema;
  } else {
    T value;
    return schema_of_fields(value);
  }
}

}  // namespace detail

/// JSON Schema (draft 2020-12) of the files that read_file<T> accepts. Rules that span several fields are not in it.
template <class T>
Json schema(const std::string& title) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(detail::schema_of_struct<T>());
  if (schema.contains("properties")) schema["properties"]["$schema"] = {{"type", "string"}};
  return schema;
}

}  // namespace inslab::json
