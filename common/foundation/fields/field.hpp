#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// One declaration per data field.
///
/// A struct that goes over the wire, into a file or into the configuration lists its fields once:
///
///   template <class Self, class Visitor>
///   static void fields(Self& self, Visitor& visit) {
///     visit(Field("arw_deg_per_sqrt_h", "angle random walk").in(0.0, 1e3), self.arw_deg_per_sqrt_h);
///   }
///
/// The CDR codec, the strict JSON reader, the schema, the IDL of the profiles, the CSV and HDF5 columns and the
/// reference page are visitors of that list. Order is the order on the wire.
///
/// Kinds of field: bool, the integers uint8/uint32/int64/uint64, double, std::string (with a bound), enums described by
/// `EnumNames`, Vector3/Quaternion/Vector6/Vector9 (fixed arrays of double), RunId, `std::vector<struct>` (with a
/// bound), and nested structs. Configuration (never on the wire) may also use std::optional of these.
///
/// The structs live in the inline namespace `samples`, so that they share their names with the types generated from
/// idl/, which live in `inslab` itself, without being the same types to the linker.
namespace inslab {
inline namespace samples {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector9 = Eigen::Matrix<double, 9, 1>;  // a 3x3 matrix row by row
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;  // Hamilton; scalar first in files and on the wire

/// What is known of a field besides its C++ type. The name carries the unit as its suffix.
struct Field {
  explicit constexpr Field(std::string_view field_name, std::string_view field_meaning = {})
      : name(field_name), meaning(field_meaning) {}

  /// Closed interval of admissible values, per element.
  constexpr Field in(double low, double high) const {
    Field field = *this;
    field.minimum = low;
    field.maximum = high;
    return field;
  }
  /// Largest number of characters of a string or elements of a list.
  constexpr Field at_most(std::size_t bound) const {
    Field field = *this;
    field.max_size = bound;
    return field;
  }
  /// The key must be present in JSON; other fields keep their default when absent.
  constexpr Field required() const {
    Field field = *this;
    field.is_required = true;
    return field;
  }
  /// Part of the DDS key.
  constexpr Field key() const {
    Field field = *this;
    field.is_key = true;
    return field;
  }
  /// Given for one kind of sensor alone, by its name; for others it keeps its default.
  constexpr Field only_for(std::string_view kind_of_sensor) const {
    Field field = *this;
    field.sensor_kind = kind_of_sensor;
    return field;
  }
  /// Came with a later version of the wire types, at the end of its struct: samples in earlier logs lack it, and it
  /// keeps its default then.
  constexpr Field appended() const {
    Field field = *this;
    field.is_appended = true;
    return field;
  }
  /// Came with a later version of the wire types, in a struct behind which others follow: samples in earlier logs lack
  /// it, and it keeps its default then.
  constexpr Field inserted() const {
    Field field = *this;
    field.is_inserted = true;
    return field;
  }
  /// A value that a sensor measures; `least` and `most` are what sensors of the kind can show at all, in its unit.
  constexpr Field measured(double least, double most) const {
    Field field = *this;
    field.is_measured = true;
    field.least_shown = least;
    field.most_shown = most;
    return field;
  }
  /// On the wire but not in JSON files: set by the software.
  constexpr Field wire_only() const {
    Field field = *this;
    field.is_wire_only = true;
    return field;
  }

  std::string_view name;
  std::string_view meaning;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  double least_shown = 0.0;
  double most_shown = 0.0;
  std::size_t max_size = 64;
  std::string_view sensor_kind;
  bool is_required = false;
  bool is_key = false;
  bool is_wire_only = false;
  bool is_appended = false;
  bool is_inserted = false;
  bool is_measured = false;
};

/// Specialised for every enum on the wire or in JSON: `type` is the IDL name, `prefix` the enumerators' prefix there,
/// `values` their JSON names, in order from 0. Where a source numbers the enumerators, JSON takes these `numbers` too:
/// one for each of the first enumerators, in their order.
template <class Enum>
struct EnumNames;

/// The JSON name of an enumerator; "?" when the value is outside the enum.
template <class Enum>
std::string_view enum_name(Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < EnumNames<Enum>::values.size() ? EnumNames<Enum>::values[index] : std::string_view("?");
}

/// The enumerator of that JSON name, if there is one.
template <class Enum>
std::optional<Enum> enum_named(std::string_view name) {
  for (std::size_t i = 0; i < EnumNames<Enum>::values.size(); ++i) {
    if (EnumNames<Enum>::values[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

/// The JSON names of all enumerators.
template <class Enum>
std::vector<std::string> enum_words() {
  return {EnumNames<Enum>::values.begin(), EnumNames<Enum>::values.end()};
}

namespace detail {
struct AnyVisitor {
  template <class T>
  void operator()(const Field&, T&) {}
};
template <class T, class = void>
struct HasFields : std::false_type {};
template <class T>
struct HasFields<T, std::void_t<decltype(T::fields(std::declval<T&>(), std::declval<AnyVisitor&>()))>>
    : std::true_type {};
template <class Enum, class = void>
struct EnumHasNumbers : std::false_type {};
template <class Enum>
struct EnumHasNumbers<Enum, std::void_t<decltype(EnumNames<Enum>::numbers)>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
}  // namespace detail

/// True for structs that list their fields.
template <class T>
inline constexpr bool has_fields = samples::detail::HasFields<std::remove_const_t<T>>::value;

/// True for enums that JSON may give by number too.
template <class Enum>
inline constexpr bool enum_has_numbers = detail::EnumHasNumbers<Enum>::value;

/// The number that JSON may give instead of the enumerator's name, if it has one.
template <class Enum>
std::optional<std::uint32_t> enum_number(Enum value) {
  if constexpr (enum_has_numbers<Enum>) {
    const auto index = static_cast<std::size_t>(value);
    if (index < EnumNames<Enum>::numbers.size()) return EnumNames<Enum>::numbers[index];
  }
  return std::nullopt;
}

/// The enumerator of that number, if there is one.
template <class Enum>
std::optional<Enum> enum_of_number(std::int64_t number) {
  if constexpr (enum_has_numbers<Enum>) {
    for (std::size_t i = 0; i < EnumNames<Enum>::numbers.size(); ++i) {
      if (number == EnumNames<Enum>::numbers[i]) return static_cast<Enum>(i);
    }
  }
  return std::nullopt;
}

/// True for std::vector.
template <class T>
inline constexpr bool is_list = samples::detail::IsVector<std::remove_const_t<T>>::value;

/// True for std::optional.
template <class T>
inline constexpr bool is_optional = detail::IsOptional<std::remove_const_t<T>>::value;

/// 128 random bits that tell one run from another.
struct RunId {
  std::array<std::uint8_t, 16> bytes{};
  friend bool operator==(const RunId& a, const RunId& b) { return a.bytes == b.bytes; }
  friend bool operator!=(const RunId& a, const RunId& b) { return !(a == b); }
};

}  // namespace samples
}  // namespace inslab
