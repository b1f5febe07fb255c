#pragma once

#include <sstream>

#include "config/schema_writer.hpp"

namespace inslab::config {

namespace detail {

/// Markdown rows of a struct's fields; nested structs follow with their path before them.
class ReferenceWriter {
 public:
  explicit ReferenceWriter(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  std::ostringstream rows;

  template <class T>
  void operator()(const Field& field, T& value) {
    if (!field.is_wire_only) row(field, prefix_ + std::string(field.name), value);
  }

 private:
  template <class T>
  void row(const Field& field, const std::string& path, T& value) {
    if constexpr (is_optional<T>) {
      typename T::value_type present{};
      row(field, path, present);
    } else if constexpr (is_list<T>) {
      line(field, path, "list of up to " + std::to_string(field.max_size), "empty");
      typename T::value_type element{};
      if constexpr (has_fields<typename T::value_type>) nested(path + "[].", element);
    } else if constexpr (has_fields<T>) {
      line(field, path, "object", "");
      nested(path + ".", value);
    } else {
      line(field, path, type_of(field, value), default_of(value));
    }
  }

  template <class T>
  void nested(const std::string& prefix, T& value) {
    if constexpr (HasDiscriminator<T>::value) {
      for (std::size_t i = 0, count = 1; i < count; ++i) {
        DiscriminatorSetter setter{i, {}, 0};
        T::fields(value, setter);
        count = setter.alternatives;
        ReferenceWriter inner(prefix);
        T::fields(value, inner);
        rows << inner.rows.str();
      }
    } else {
      ReferenceWriter inner(prefix);
      T::fields(value, inner);
      rows << inner.rows.str();
    }
  }

  void line(const Field& field, const std::string& path, const std::string& type, const std::string& initial) {
    rows << "| `" << path << "` | " << type << " | " << (field.is_required ? "required" : initial) << " | "
         << field.meaning << " |\n";
  }

  static std::string range(const Field& field) {
    std::ostringstream text;
    if (std::isfinite(field.minimum)) text << ", " << field.minimum << " to " << field.maximum;
    return text.str();
  }

  template <class T>
  static std::string type_of(const Field& field, const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      return "true or false";
    } else if constexpr (std::is_enum_v<T>) {
      (void)value;
      std::string text;
      for (const std::string_view name : EnumNames<T>::values) text += (text.empty() ? "" : ", ") + std::string(name);
      return text;
    } else if constexpr (std::is_same_v<T, double>) {
      return "number" + range(field);
    } else if constexpr (std::is_integral_v<T>) {
      return "whole number" + range(field);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "text of up to " + std::to_string(field.max_size);
    } else {
      return "number or list of " + std::to_string(value.size()) + range(field);
    }
  }

  template <class T>
  static std::string default_of(const T& value) {
    std::ostringstream text;
    if constexpr (std::is_same_v<T, bool>) {
      text << (value ? "true" : "false");
    } else if constexpr (std::is_enum_v<T>) {
      text << enum_name(value);
    } else if constexpr (std::is_arithmetic_v<T>) {
      text << value;
    } else if constexpr (!std::is_same_v<T, std::string>) {
      text << 0;
    }
    return text.str();
  }

  std::string prefix_;
};

}  // namespace detail

/// A Markdown table of every key of a file that read_file<T> accepts.
template <class T>
std::string reference_table() {
  T value;
  detail::ReferenceWriter writer;
  T::fields(value, writer);
  return "| key | value | default | meaning |\n| --- | --- | --- | --- |\n" + writer.rows.str();
}

}  // namespace inslab::config
