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
  bool known_miss = false;  ///< it does not hold, and known_misses.hpp says so of everything in it that does not
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<Row> rows;
  std::vector<std::string> notes;          ///< printed under the table: the reference used, what a column means
  bool judged = true;                      ///< false: figures to look at, no row passes or fails
  std::vector<std::string> left_out = {};  ///< rows for which there are no data here, said in the verdict

  /// Whether every row held, known misses aside; a judged table without rows has shown nothing.
  bool held() const;
  std::size_t misses() const;  ///< the known ones
};

/// The table with aligned columns and at the end of each row PASS, FAIL, or MISS for a known one.
std::string to_text(const Table& table);

}  // namespace inslab::verify
