#pragma once

#include <string>
#include <vector>

#include "inslab/formats/tables/columns.hpp"
#include "inslab/foundation/files/output_file.hpp"

namespace inslab::tables {

/// One cell as it stands in a CSV file.
std::string csv_text(const Cell& cell);

/// Writes a table as CSV (RFC 4180, lines end in \n): one line of names, then the rows. Doubles have the fewest digits
/// that read back to the same bits (at most 17); bool is 0 or 1; enums are their names; what is empty stays empty.
class CsvWriter {
 public:
  /// The file has its name when it is closed. Throws WriteError.
  CsvWriter(const std::string& path, const std::vector<Column>& columns);

  /// One cell for each column. Throws WriteError.
  void row(const Row& cells);

  /// Throws WriteError.
  void close();

 private:
  void drain();

  files::OutputFile file_;
  std::string buffer_;
};

}  // namespace inslab::tables
