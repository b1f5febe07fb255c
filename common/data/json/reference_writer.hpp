#pragma once

#include <algorithm>
#include <sstream>
#include <vector>

#include "inslab/data/json/schema_writer.hpp"

namespace inslab::json {

namespace detail {

/// Markdown rows of a struct's fields; nested structs follow with their path before them.
class ReferenceWriter {
 public:
  explicit ReferenceWriter(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  struct Row {
    std::string text;  ///< all but the meaning
    std::string meaning;
    std::string path;
  };
  std::vector<Row> rows;

  template <class T>
  void operator()(const Field& field, T& value) {
    if (!field.is_wire_only) row(field, prefix_ + std::string(field.name), value);
  }

 private:
  template <class T>
  void row(const Field& field, const std::string& path, T& value) {
    if constexpr (is_optional<T>) {
      typename T::value_type present{};
      if constexpr (has_fields<typename T::value_type>) {
        row(field, path, present);
      } else {
        line(field, path, type_of(field, present), "");
      }
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
      alternatives(prefix, value);
    } else {
      ReferenceWriter inner(prefix);
      T::fields(value, inner);
      rows.insert(rows.end(), inner.rows.begin(), inner.rows.end());
    }
  }

  /// Each row once, with the values of the discriminator that have it unless all have or what encloses it says so.
  template <class T>
  void alternatives(const std::string& prefix, T& value) {
    std::vector<Row> merged;
    std::vector<std::vector<std::string>> holders;
    ReferenceWriter as_declared(prefix);
    T::fields(value, as_declared);
    DiscriminatorSetter setter{0, {}, 1, {}, {}};
    for (std::size_t i = 0; i < setter.alternatives; ++i) {
      setter = {i, {}, 0, {}, {}};
      T::fields(value, setter);
      ReferenceWriter inner(prefix);
      T::fields(value, inner);
      inner.rows.front() = as_declared.rows.front();  // the discriminator, with the default it had before it was set
      for (const Row& row : inner.rows) {
        const auto same = std::find_if(merged.begin(), merged.end(), [&](const Row& r) { return r.text == row.text; });
        if (same == merged.end()) holders.emplace_back();
        holders[static_cast<std::size_t>(same - merged.begin())].push_back(setter.value_name);
        if (same == merged.end()) merged.push_back(row);
      }
    }
    const Row* said = nullptr;
    for (std::size_t i = 0; i < merged.size(); ++i) {
      const bool is_inside = said != nullptr && merged[i].path.size() > said->path.size() &&
                             merged[i].path.compare(0, said->path.size(), said->path) == 0 &&
                             std::string_view(".[").find(merged[i].path[said->path.size()]) != std::string_view::npos;
      if (holders[i].size() < setter.alternatives && !is_inside) {
        std::string of = setter.key + " ";
        for (const std::string& name : holders[i]) of += (&name == &holders[i].front() ? "" : ", ") + name;
        merged[i].meaning = of + (merged[i].meaning.empty() ? "" : ": " + merged[i].meaning);
        said = &merged[i];
      }
      rows.push_back(merged[i]);
    }
  }

  void line(const Field& field, const std::string& path, const std::string& type, const std::string& initial) {
    rows.push_back({"| `" + path + "` | " + type + " | " + (field.is_required ? "required" : initial) + " | ",
                    std::string(field.meaning), path});
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
      for (std::size_t i = 0; i < EnumNames<T>::values.size(); ++i) {
        const auto number = enum_number(static_cast<T>(i));
        text += (i == 0 ? "" : ", ") + std::string(EnumNames<T>::values[i]);
        if (number) text += " (" + std::to_string(*number) + ")";
      }
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
      const Eigen::Index shown = value.isConstant(value[0], 0.0) ? 1 : value.size();
      for (Eigen::Index i = 0; i < shown; ++i) text << (i == 0 ? "" : ", ") << value[i];
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
  std::string text = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const auto& row : writer.rows) text += row.text + row.meaning + " |\n";
  return text;
}

}  // namespace inslab::json
