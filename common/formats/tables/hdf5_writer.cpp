#include "inslab/formats/tables/hdf5_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "inslab/formats/tables/hdf5_handle.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/output_place.hpp"

namespace inslab::tables {
namespace {

constexpr hsize_t kRowsInChunk = 1024;
constexpr std::size_t kLargestAttribute = 60000;  // an object header message holds 64 kB

/// Declared as ASCII even where names hold UTF-8: HDF5 does not convert between the two, and Octave asks for ASCII.
Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(size, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

/// A copy that HDF5 may read at least one byte of.
std::string padded(std::string_view text) {
  std::string copy(text);
  if (copy.empty()) copy.push_back('\0');
  return copy;
}

void put_attribute(const std::string& path, hid_t object, const char* name, std::string_view text) {
  const std::string value = padded(text);
  const Hdf5Handle type = text_type(value.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle attribute(
      checked(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), path, "add an attribute"),
      &H5Aclose);
  checked(H5Awrite(attribute.get(), type.get(), value.data()), path, "write an attribute");
}

Hdf5Handle type_of(const Column& column) {
  switch (column.kind) {
    case ColumnKind::Bool:
      return Hdf5Handle(H5Tcopy(H5T_NATIVE_UINT8), &H5Tclose);
    case ColumnKind::UInt32:
    case ColumnKind::Enum:
      return Hdf5Handle(H5Tcopy(H5T_NATIVE_UINT32), &H5Tclose);
    case ColumnKind::UInt64:
      return Hdf5Handle(H5Tcopy(H5T_NATIVE_UINT64), &H5Tclose);
    case ColumnKind::Int64:
      return Hdf5Handle(H5Tcopy(H5T_NATIVE_INT64), &H5Tclose);
    case ColumnKind::Double:
      return Hdf5Handle(H5Tcopy(H5T_NATIVE_DOUBLE), &H5Tclose);
    case ColumnKind::Text:
      break;
  }
  return text_type(column.max_size);
}

/// The bytes of one value of the column's type.
class CellBytes {
 public:
  CellBytes(std::vector<std::uint8_t>& out, const Column& column, std::size_t width)
      : out_(out), kind_(column.kind), width_(width) {}

  void operator()(std::monostate) const {
    if (kind_ == ColumnKind::Double) return put(std::numeric_limits<double>::quiet_NaN());
    out_.resize(out_.size() + width_);
  }
  void operator()(bool value) const { put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void operator()(const EnumCell& value) const { put(value.value); }
  void operator()(const std::string& value) const {
    const std::size_t used = std::min(value.size(), width_);
    out_.insert(out_.end(), value.begin(), value.begin() + static_cast<std::ptrdiff_t>(used));
    out_.resize(out_.size() + width_ - used);
  }
  template <class Number>
  void operator()(Number value) const {
    put(value);
  }

 private:
  template <class T>
  void put(T value) const {
    std::uint8_t bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out_.insert(out_.end(), bytes, bytes + sizeof(T));
  }

  std::vector<std::uint8_t>& out_;
  ColumnKind kind_;
  std::size_t width_;
};

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

void throw_hdf5_error(const std::string& path, const std::string& action) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, &keep_innermost, &reason);
  // The drivers quote the system's own words.
  constexpr std::string_view kQuote = "error message = '";
  if (const std::size_t quote = reason.find(kQuote); quote != std::string::npos) {
    reason = reason.substr(quote + kQuote.size());
    reason.resize(std::min(reason.size(), reason.find('\'')));
  }
  throw files::WriteError(path + ": cannot " + action + ": " + reason);
}

class Hdf5Writer::Table::Dataset {
 public:
  Dataset(const std::string& path, hid_t group, std::string_view topic, const Column& column)
      : path_(path), column_(column), type_(type_of(column)), width_(H5Tget_size(type_.get())) {
    const hsize_t none = 0;
    const hsize_t unlimited = H5S_UNLIMITED;
    const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), &H5Sclose);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
    H5Pset_chunk(properties.get(), 1, &kRowsInChunk);
    const hid_t id =
        H5Dcreate2(group, column.name.c_str(), type_.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT);
    dataset_ = Hdf5Handle(checked(id, path_, "add the column " + column.name), &H5Dclose);
    put_attribute(path_, id, "unit", column.unit);
    put_attribute(path_, id, "topic", topic);
    if (column.kind == ColumnKind::Enum) {
      std::string names;
      for (const std::string_view name : column.enumerators) names += (names.empty() ? "" : " ") + std::string(name);
      put_attribute(path_, id, "enumerators", names);
    }
  }

  void add(const Cell& cell) { std::visit(CellBytes(buffer_, column_, width_), cell); }

  void flush() {
    const hsize_t count = buffer_.size() / width_;
    if (count == 0) return;
    const hsize_t before = rows_;
    rows_ += count;
    const std::string action = "write the column " + column_.name;
    checked(H5Dset_extent(dataset_.get(), &rows_), path_, action);
    const Hdf5Handle file_space(checked(H5Dget_space(dataset_.get()), path_, action), &H5Sclose);
    H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, &before, nullptr, &count, nullptr);
    const Hdf5Handle memory_space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
    checked(H5Dwrite(dataset_.get(), type_.get(), memory_space.get(), file_space.get(), H5P_DEFAULT, buffer_.data()),
            path_, action);
    buffer_.clear();
  }

 private:
  const std::string& path_;
  Column column_;
  Hdf5Handle type_;
  std::size_t width_;
  Hdf5Handle dataset_;
  std::vector<std::uint8_t> buffer_;
  hsize_t rows_ = 0;
};

Hdf5Writer::Table::Table(const std::string& path, std::int64_t group, std::string_view topic,
                         const std::vector<Column>& columns) {
  for (const Column& column : columns) datasets_.push_back(std::make_unique<Dataset>(path, group, topic, column));
}

Hdf5Writer::Table::~Table() = default;

void Hdf5Writer::Table::row(const Row& cells) {
  for (std::size_t i = 0; i < datasets_.size(); ++i) datasets_[i]->add(cells.at(i));
  if (++buffered_ == kRowsInChunk) flush();
}

void Hdf5Writer::Table::flush() {
  for (const auto& dataset : datasets_) dataset->flush();
  buffered_ = 0;
}

struct Hdf5Writer::State {
  explicit State(const std::string& asked_for) : path(asked_for), place(asked_for) {}
  std::string path;
  files::OutputPlace place;
  Hdf5Handle file;
  std::vector<std::unique_ptr<Table>> tables;  // closed before the file
};

Hdf5Writer::Hdf5Writer(const std::string& path) : state_(std::make_unique<State>(path)) {
  // After a full disk the library crashes in its own clean-up at exit (1.10.8), so it is told to have none; close()
  // does what is needed. It prints its errors unless told not to; they go into exceptions here.
  static const herr_t kNoCleanUp = H5dont_atexit();
  static_cast<void>(kNoCleanUp);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  state_->file = Hdf5Handle(
      checked(H5Fcreate(state_->place.growing().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), path, "create"),
      &H5Fclose);
}

Hdf5Writer::~Hdf5Writer() {
  state_->tables.clear();
  state_->file.close();
}

Hdf5Writer::Table& Hdf5Writer::add_table(const std::string& name, std::string_view topic, std::string_view type,
                                         const std::vector<Column>& columns) {
  const std::string& path = state_->path;
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
  H5Pset_create_intermediate_group(links.get(), 1);
  const Hdf5Handle group(checked(H5Gcreate2(state_->file.get(), name.c_str(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
                                 path, "add the group " + name),
                         &H5Gclose);
  put_attribute(path, group.get(), "topic", topic);
  put_attribute(path, group.get(), "type", type);
  state_->tables.push_back(std::make_unique<Table>(path, group.get(), topic, columns));
  return *state_->tables.back();
}

void Hdf5Writer::attribute(const std::string& name, std::string_view value) {
  if (value.size() <= kLargestAttribute) {
    put_attribute(state_->path, state_->file.get(), name.c_str(), value);
    return;
  }
  const std::string action = "add the text " + name;
  const Hdf5Handle type = text_type(value.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle dataset(checked(H5Dcreate2(state_->file.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                              H5P_DEFAULT, H5P_DEFAULT),
                                   state_->path, action),
                           &H5Dclose);
  checked(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), state_->path, action);
}

void Hdf5Writer::close() {
  if (state_->file.get() < 0) return;
  try {
    for (const auto& table : state_->tables) table->flush();
    checked(H5Fflush(state_->file.get(), H5F_SCOPE_LOCAL), state_->path, "write");
  } catch (const files::WriteError&) {
    state_->tables.clear();
    state_->file.close();
    throw;
  }
  state_->tables.clear();
  checked(state_->file.close(), state_->path, "close");
  state_->place.commit();
}

}  // namespace inslab::tables
