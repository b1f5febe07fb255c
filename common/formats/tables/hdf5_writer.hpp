#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "inslab/formats/tables/columns.hpp"

namespace inslab::tables {

/// Writes tables into one HDF5 file: a group for each table, a one-dimensional, extendable dataset for each column.
///
/// bool is uint8, enums are uint32 (attribute `enumerators`: their names, in order, separated by blanks), text is a
/// fixed-length string padded with NUL; what is empty is 0, NaN or "". Every dataset has the attributes `unit` and
/// `topic`.
class Hdf5Writer {
 public:
  class Table;

  /// The file has its name when it is closed. Throws WriteError.
  explicit Hdf5Writer(const std::string& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Adds the group `name` ("inslab/imu/0" lies inside groups inslab and imu) for the samples of `topic`, with the
  /// attributes `topic` and `type`. The table lives as long as the writer. Throws WriteError, also for a name that is
  /// taken.
  Table& add_table(const std::string& name, std::string_view topic, std::string_view type,
                   const std::vector<Column>& columns);

  /// Sets a string attribute of the file; longer than an attribute can be (64 kB), it becomes a dataset `name`. Throws
  /// WriteError.
  void attribute(const std::string& name, std::string_view value);

  /// Writes what is buffered and closes the file. Throws WriteError.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One group of an HDF5 file.
class Hdf5Writer::Table {
 public:
  class Dataset;

  Table(const std::string& path, std::int64_t group, std::string_view topic, const std::vector<Column>& columns);
  ~Table();

  /// One cell for each column. Throws WriteError.
  void row(const Row& cells);

  /// Writes what is buffered. Throws WriteError.
  void flush();

 private:
  std::vector<std::unique_ptr<Dataset>> datasets_;
  std::size_t buffered_ = 0;
};

}  // namespace inslab::tables
