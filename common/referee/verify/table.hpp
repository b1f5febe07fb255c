#pragma once

#include <string>
#include <vector>

/// What `inslab verify NAME` prints and the tests read: figures of the product beside those of the seed document and
/// the limit that decides.
namespace inslab::verify {

/// One line; `cells` has as many entries as the table has columns.
struct Row {
  std::vector<std::string> cells;
  bool held = true;
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<Row> rows;
  std::vector<std::string> notes;  ///< printed under the table: the reference used, what a column means
  bool judged = true;              ///< false: figures to look at, no row passes or fails

  /// Whether every row held; a judged table without rows has shown nothing.
  bool held() const;
};

/// The table with aligned columns and PASS or FAIL at the end of each row.
std::string to_text(const Table& table);

}  // namespace inslab::verify
