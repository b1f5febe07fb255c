#include "inslab/referee/verify/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace inslab::verify {

bool Table::held() const {
  if (!judged) return true;
  return !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.held || row.known_miss; });
}

std::size_t Table::misses() const {
  if (!judged) return 0;
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.held && row.known_miss; }));
}

namespace {

const char* verdict_of(const Row& row) { return row.held ? "PASS" : row.known_miss ? "MISS" : "FAIL"; }

}  // namespace

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t width = table.columns[i].size();
    for (const Row& row : table.rows) width = std::max(width, row.cells.at(i).size());
    widths.push_back(width);
  }
  // The first column names the row; figures line up at their right ends.
  const auto line = [&widths](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      text += i == 0 ? fmt::format("{:<{}}", cells[i], widths[i]) : fmt::format("  {:>{}}", cells[i], widths[i]);
    }
    return text;
  };
  std::string text = table.title + "\n\n" + line(table.columns) + "\n";
  for (const Row& row : table.rows) {
    text += line(row.cells) + (table.judged ? std::string("  ") + verdict_of(row) : "") + "\n";
  }
  for (const std::string& note : table.notes) text += "\n" + note + "\n";
  return text;
}

}  // namespace inslab::verify
