#include "inslab/foundation/files/input_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace inslab::scenario {
namespace input_limits_test {

/// "4,000,000"
std::string with_commas(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return digits;
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

TEST(InputLimits, AreThoseOfTheDocumentation) {
  std::ifstream in(std::string(INSLAB_SOURCE_DIR) + "/docs/formats.md");
  const std::string docs((std::istreambuf_iterator<char>(in)), {});
  const std::vector<std::string> rows{
      "results) | " + mebibytes(files::kMaxJsonBytes) + ", " + with_commas(files::kMaxJsonValues) + " values, " +
          std::to_string(files::kMaxJsonLevels) + " levels;",
      "import`) | " + mebibytes(files::kMaxImportBytes) + ", " + std::to_string(files::kMaxImportLevels) +
          " levels (of YAML 500",
      "lines) | " + with_commas(files::kMaxLineBytes) + " bytes in a line; " + with_commas(files::kMaxRowsInMemory) +
          " rows",
      "(MCAP) | " + mebibytes(files::kMaxLogRecordBytes) + " for a record",
      "; " + std::to_string(files::kMaxOpenLogBytes >> 30) + " GiB of chunks that overlap in time |"};
  for (const std::string& row : rows) EXPECT_THAT(docs, testing::HasSubstr(row));
}

}  // namespace input_limits_test
}  // namespace inslab::scenario
