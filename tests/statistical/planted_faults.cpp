#include "tests/statistical/planted_faults.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <map>

namespace inslab::verify {

namespace {

bool is_figure(const std::string& cell) {
  return cell.empty() || std::isdigit(static_cast<unsigned char>(cell.front())) != 0 || cell.front() == '-' ||
         cell.front() == '+';
}

using Names = std::set<std::string>;

Names rows_of(const Tables& tables, bool (*wanted)(const Row& row)) {
  Names names;
  std::map<std::string, int> times;  // rows of one name differ in a figure that is set: a frequency, a parameter
  for (const Table& table : tables) {
    if (!table.judged) continue;
    for (const Row& row : table.rows) {
      std::string name = name_of_row(table, row);
      if (const int before = times[name]++; before > 0) name += ", number " + std::to_string(before + 1);
      if (wanted(row)) names.insert(name);
    }
  }
  return names;
}

bool any(const Row&) { return true; }
bool fails(const Row& row) { return !row.held && !row.known_miss; }

}  // namespace

std::string name_of_row(const Table& table, const Row& row) {
  std::string name = table.title + " | " + row.cells.front();
  for (std::size_t i = 1; i < row.cells.size() && !is_figure(row.cells[i]); ++i) name += ", " + row.cells[i];
  return name;
}

void expect_each_row_to_fail_by_some_fault(const std::function<Tables()>& sound,
                                           const std::vector<PlantedFault>& faults) {
  Names rows, failed;
  if (sound) {
    const Tables tables = sound();
    rows = rows_of(tables, any);
    for (const Table& table : tables) EXPECT_TRUE(table.held()) << to_text(table);
  }
  for (const PlantedFault& fault : faults) {
    const Tables tables = fault.with_it();
    const Names seen = rows_of(tables, fails);
    EXPECT_FALSE(seen.empty()) << "no row sees " << fault.what;
    failed.insert(seen.begin(), seen.end());
    const Names looked_at = rows_of(tables, any);
    rows.insert(looked_at.begin(), looked_at.end());
    for (const std::string& row : seen) std::printf("%s: fails with %s\n", row.c_str(), fault.what.c_str());
  }
  for (const std::string& row : rows) {
    EXPECT_EQ(failed.count(row), 1U) << "no planted fault makes this row fail: " << row;
  }
}

}  // namespace inslab::verify
