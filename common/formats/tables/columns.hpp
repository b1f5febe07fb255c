#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

/// A struct that lists its fields, as named columns: the layout of CSV and HDF5.
///
/// Nested names are joined with a dot: header.sim_time_ns, gyro_error_rad.bias.x. Vectors end in .x .y .z, quaternions
/// in .w .x .y .z, cross axes in .xy .xz .yx .yz .zx .zy (error of the first axis from the second). A list of at most
/// n structs is its count and n groups of columns, streams.count, streams.0.topic, ...; those beyond the count are
/// empty. A run id is 32 hexadecimal digits.
namespace inslab::tables {

enum class ColumnKind { Bool, UInt32, UInt64, Int64, Double, Enum, Text };

struct Column {
  std::string name;
  std::string unit;  ///< such as "m/s"; "1" for plain numbers, "" for what is not a number
  ColumnKind kind = ColumnKind::Double;
  std::size_t max_size = 0;                     ///< Text: largest number of bytes
  std::vector<std::string_view> enumerators{};  ///< Enum: the names, from 0
};

/// An enumerator and its name.
struct EnumCell {
  std::uint32_t value = 0;
  std::string_view name;
};

/// The value of one column in one row, in the order of ColumnKind; std::monostate: empty.
using Cell =
    std::variant<std::monostate, bool, std::uint32_t, std::uint64_t, std::int64_t, double, EnumCell, std::string>;
using Row = std::vector<Cell>;

/// The unit that the suffix of `name` or of what encloses it says: "v_n_m_per_s.x" gives "m/s"; "1" without suffix.
std::string unit_of(std::string_view name);

/// 32 lower-case hexadecimal digits.
std::string to_hex(const RunId& run_id);

namespace detail {

inline constexpr std::string_view kVectorAxes[] = {"x", "y", "z"};
inline constexpr std::string_view kQuaternionAxes[] = {"w", "x", "y", "z"};
inline constexpr std::string_view kCrossAxes[] = {"xy", "xz", "yx", "yz", "zx", "zy"};
inline constexpr std::string_view kMatrixAxes[] = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};

class ColumnLister {
 public:
  template <class T>
  void operator()(const Field& field, const T& value) {
    const std::size_t parent = prefix_.size();
    if (!prefix_.empty()) prefix_ += '.';
    prefix_ += field.name;
    add(field, value);
    prefix_.resize(parent);
  }

  std::vector<Column> take() { return std::move(columns_); }

 private:
  template <class T>
  void add(const Field& field, const T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      columns_.push_back({prefix_, "", ColumnKind::Text, 2 * value.bytes.size()});
    } else if constexpr (std::is_same_v<T, std::string>) {
      columns_.push_back({prefix_, "", ColumnKind::Text, field.max_size});
    } else if constexpr (std::is_same_v<T, bool>) {
      columns_.push_back({prefix_, "", ColumnKind::Bool});
    } else if constexpr (std::is_enum_v<T>) {
      columns_.push_back({prefix_, "", ColumnKind::Enum});
      columns_.back().enumerators.assign(EnumNames<T>::values.begin(), EnumNames<T>::values.end());
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      columns_.push_back({prefix_, unit_of(prefix_), ColumnKind::Int64});
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
      columns_.push_back({prefix_, unit_of(prefix_), ColumnKind::UInt64});
    } else if constexpr (std::is_integral_v<T>) {
      columns_.push_back({prefix_, unit_of(prefix_), ColumnKind::UInt32});
    } else if constexpr (std::is_same_v<T, double>) {
      columns_.push_back({prefix_, unit_of(prefix_), ColumnKind::Double});
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      add_axes(kQuaternionAxes);
    } else if constexpr (std::is_same_v<T, Vector6>) {
      add_axes(kCrossAxes);
    } else if constexpr (std::is_same_v<T, Vector9>) {
      add_axes(kMatrixAxes);
    } else if constexpr (std::is_same_v<T, Vector3>) {
      add_axes(kVectorAxes);
    } else if constexpr (is_list<T>) {
      columns_.push_back({prefix_ + ".count", "1", ColumnKind::UInt32});
      const typename T::value_type element{};
      for (std::size_t i = 0; i < field.max_size; ++i) {
        const std::string number = std::to_string(i);
        (*this)(Field(number), element);
      }
    } else {
      T::fields(value, *this);
    }
  }

  template <std::size_t n>
  void add_axes(const std::string_view (&axes)[n]) {
    for (const std::string_view axis : axes) {
      const std::string name = prefix_ + "." + std::string(axis);
      columns_.push_back({name, unit_of(name), ColumnKind::Double});
    }
  }

  std::string prefix_;
  std::vector<Column> columns_;
};

class RowFiller {
 public:
  explicit RowFiller(Row& row) : row_(row) { row_.clear(); }

  template <class T>
  void operator()(const Field& field, const T& value) {
    if constexpr (std::is_same_v<T, RunId>) {
      add(to_hex(value));
    } else if constexpr (std::is_enum_v<T>) {
      add(EnumCell{static_cast<std::uint32_t>(value), enum_name(value)});
    } else if constexpr (std::is_integral_v<T> && sizeof(T) < 4 && !std::is_same_v<T, bool>) {
      add(static_cast<std::uint32_t>(value));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      add(value);
    } else if constexpr (std::is_same_v<T, Quaternion>) {
      for (const double component : {value.w(), value.x(), value.y(), value.z()}) add(component);
    } else if constexpr (is_list<T>) {
      add(static_cast<std::uint32_t>(value.size()));
      const bool within = empty_;
      const typename T::value_type nothing{};
      for (std::size_t i = 0; i < field.max_size; ++i) {
        empty_ = within || i >= value.size();
        (*this)(field, empty_ ? nothing : value[i]);
      }
      empty_ = within;
    } else if constexpr (has_fields<T>) {
      T::fields(value, *this);
    } else {
      for (Eigen::Index i = 0; i < value.size(); ++i) add(value[i]);
    }
  }

 private:
  template <class T>
  void add(T value) {
    if (empty_) {
      row_.emplace_back();
    } else {
      row_.emplace_back(std::move(value));
    }
  }

  Row& row_;
  bool empty_ = false;
};

}  // namespace detail

/// The columns of T, in the order of its fields.
template <class T>
std::vector<Column> columns_of() {
  detail::ColumnLister lister;
  const T value{};
  T::fields(value, lister);
  return lister.take();
}

/// Replaces `row` by the values of `value`, one for each of columns_of<T>().
template <class T>
void fill_row(const T& value, Row& row) {
  detail::RowFiller filler(row);
  T::fields(value, filler);
}

}  // namespace inslab::tables
