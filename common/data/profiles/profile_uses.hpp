#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

/// What those who work with profiles do with each of their fields. A consumer declares a list beside its code; a test
/// walks the fields and demands an entry for each, so that a new term cannot be forgotten without a word.
namespace inslab::profiles {

/// One field, by its path ("gyro.arw_deg_per_sqrt_h", "linear[].frequency_hz"); "recorded_error.*" is every field of
/// that part, an empty path a whole profile.
struct FieldUse {
  enum class What { Handled, NoError, LeftOut };
  std::string_view path;
  What what;
  std::string_view name = {};    ///< of what is left out, as it is shown; several fields may share one
  std::string_view reason = {};  ///< why it is left out, or why it makes no error
};
constexpr FieldUse handled(std::string_view path) { return {path, FieldUse::What::Handled}; }
/// It says how another field is meant, or nothing about what comes out wrong.
constexpr FieldUse no_error(std::string_view path, std::string_view reason) {
  return {path, FieldUse::What::NoError, {}, reason};
}
constexpr FieldUse left_out(std::string_view path, std::string_view name, std::string_view reason) {
  return {path, FieldUse::What::LeftOut, name, reason};
}

namespace detail {

/// Every field with its numbers in one row; those of a list's elements behind each other. The profile's own texts and
/// what the software sets itself are left away.
class FieldNumbers {
 public:
  struct Entry {
    std::string path;
    std::vector<double> numbers;
  };
  std::vector<Entry> entries;

  template <class T>
  void operator()(const Field& field, T& value) {
    if (!field.is_wire_only) add(prefix_ + std::string(field.name), value);
  }

 private:
  template <class T>
  void add(const std::string& path, const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      // Those of the profile itself are for people; one of a part, such as a file's name, says what is on.
      if (!prefix_.empty()) numbers_of(path).push_back(static_cast<double>(value.size()));
    } else if constexpr (is_list<T>) {
      add_elements(path + "[]", value);
    } else if constexpr (has_fields<T>) {
      const std::string outer = std::exchange(prefix_, path + ".");
      T::fields(value, *this);
      prefix_ = outer;
    } else if constexpr (std::is_enum_v<T> || std::is_arithmetic_v<T>) {
      numbers_of(path).push_back(static_cast<double>(value));
    } else {
      for (const double number : value) numbers_of(path).push_back(number);
    }
  }
  template <class T>
  void add_elements(const std::string& path, const std::vector<T>& elements) {
    for (const T& element : elements) add(path, element);
    // Of an empty list the fields are known from an element that is not in it.
    FieldNumbers declared;
    declared.add(path, T());
    for (const Entry& entry : declared.entries) numbers_of(entry.path);
  }
  std::vector<double>& numbers_of(const std::string& path) {
    for (Entry& entry : entries) {
      if (entry.path == path) return entry.numbers;
    }
    return entries.emplace_back(Entry{path, {}}).numbers;
  }

  std::string prefix_;
};

template <class Profile>
std::vector<FieldNumbers::Entry> numbers_of(const Profile& profile) {
  FieldNumbers numbers;
  Profile::fields(profile, numbers);
  return std::move(numbers.entries);
}

inline bool is_of(const FieldUse& use, std::string_view path) {
  constexpr std::string_view kAll = ".*";
  if (use.path.empty() || use.path == path) return true;
  if (use.path.size() < kAll.size() || use.path.substr(use.path.size() - kAll.size()) != kAll) return false;
  const std::string_view part = use.path.substr(0, use.path.size() - 1);
  return path.substr(0, part.size()) == part;
}

template <class Uses>
const FieldUse* use_of(const Uses& uses, std::string_view path) {
  const auto found =
      std::find_if(std::begin(uses), std::end(uses), [&](const FieldUse& use) { return is_of(use, path); });
  return found == std::end(uses) ? nullptr : &*found;
}

}  // namespace detail

/// The names of what a profile sets and the consumer leaves out, each once. A profile that is left out whole counts as
/// set.
template <class Profile, class Uses>
std::vector<std::string> names_left_out(const Uses& uses, const Profile& profile) {
  std::vector<std::string> names;
  const auto entries = detail::numbers_of(profile), defaults = detail::numbers_of(Profile());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const FieldUse* use = detail::use_of(uses, entries[i].path);
    if (use == nullptr || use->what != FieldUse::What::LeftOut) continue;
    if (!use->path.empty() && entries[i].numbers == defaults[i].numbers) continue;
    if (std::find(names.begin(), names.end(), use->name) == names.end()) names.emplace_back(use->name);
  }
  return names;
}

/// What is wrong with a declaration, a sentence a line that says what to do; empty when nothing is. `file` is where it
/// stands.
template <class Profile, class Uses>
std::string faults_of(const Uses& uses, const std::string& file) {
  const std::string kind(enum_name(Profile::kind));
  const auto entries = detail::numbers_of(Profile());
  std::string text;
  for (const auto& entry : entries) {
    if (detail::use_of(uses, entry.path) != nullptr) continue;
    text += "'" + entry.path + "' of the profile " + kind + " is not declared in " + file +
            ": handle it there and say handled(), or say left_out() with a name and the reason, or no_error().\n";
  }
  for (const FieldUse& use : uses) {
    const bool is_field =
        std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return detail::is_of(use, entry.path); });
    if (!is_field) {
      text += "'" + std::string(use.path) + "' in " + file + " is no field of the profile " + kind +
              ": take it out, or rename it with the field.\n";
    }
    if (use.what != FieldUse::What::Handled && use.reason.empty()) {
      text += "'" + std::string(use.path) + "' in " + file + " gives no reason.\n";
    }
  }
  return text;
}

}  // namespace inslab::profiles
