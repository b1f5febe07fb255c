// What an attacker finds who gets into a service: programs built against it, and units that may do little.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "inslab/data/catalog/services.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace hardened_test {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;

class HardenedProgram : public testing::TestWithParam<std::string> {};

TEST_P(HardenedProgram, IsPositionIndependentBoundAtItsStartAndWatchesItsStack) {
  Process readelf("readelf",
                  {"-W", "--file-header", "--dynamic", "--program-headers", "--dyn-syms", program(GetParam())});
  if (readelf.wait(seconds(30)) != 0) GTEST_SKIP() << "no readelf here: " << readelf.output();
  const std::string said = readelf.output();
  EXPECT_THAT(said, ContainsRegex("Type: +DYN"));
  EXPECT_THAT(said, ContainsRegex("FLAGS_1\\).*NOW.* PIE"));
  EXPECT_THAT(said, HasSubstr("GNU_RELRO"));
  EXPECT_THAT(said, ContainsRegex("GNU_STACK .* RW "));
  EXPECT_THAT(said, HasSubstr("__stack_chk_fail"));
  EXPECT_THAT(said, ContainsRegex("__(memcpy|memmove|snprintf|fprintf|printf|vsnprintf|memset|read|strcpy)_chk"));
}

/// HDF5 brings a web client, a directory client and two TLS libraries into a process: 29 libraries, 4.5 MB resident.
TEST_P(HardenedProgram, LoadsNoHdf5UnlessItWritesTables) {
  if (GetParam() == "inslab") return;
  Process readelf("readelf", {"-W", "--dynamic", program(GetParam())});
  if (readelf.wait(seconds(30)) != 0) GTEST_SKIP() << "no readelf here: " << readelf.output();
  EXPECT_THAT(readelf.output(), HasSubstr("NEEDED"));
  EXPECT_THAT(readelf.output(), testing::Not(ContainsRegex("NEEDED[^\n]*hdf5")));
}

std::vector<std::string> programs() {
  std::vector<std::string> names{"inslab"};
  for (const catalog::Service& service : catalog::services()) names.emplace_back(service.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Named, HardenedProgram, testing::ValuesIn(programs()), [](const auto& instance) {
  std::string name = instance.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// The units as they are installed: their programs where they say.
class LabUnits : public testing::Test {
 protected:
  void SetUp() override {
    Process version("systemd-analyze", {"--version"});
    if (version.wait(seconds(20)) != 0) GTEST_SKIP() << "no systemd-analyze here";
    std::filesystem::copy(source("deploy/systemd"), folder_ / "units", std::filesystem::copy_options::recursive);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "units")) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      std::string text((std::istreambuf_iterator<char>(file)), {});
      for (std::size_t at = text.find("/opt/inslab"); at != std::string::npos; at = text.find("/opt/inslab")) {
        text.replace(at, 11, source(""));
      }
      std::ofstream(entry.path()) << text;
      if (entry.path().extension() == ".service") units_.push_back(entry.path());
    }
    ASSERT_FALSE(units_.empty());
  }

  TestFolder folder_;
  std::vector<std::string> units_;
};

TEST_F(LabUnits, AreUnitsThatSystemdUnderstands) {
  for (const std::string& unit : units_) {
    Process verify("systemd-analyze", {"verify", "--man=no", unit});
    EXPECT_EQ(verify.wait(seconds(30)), 0) << unit << verify.output();
  }
}

TEST_F(LabUnits, AreExposedLessThanThreeOfTen) {
  for (const std::string& unit : units_) {
    Process security("systemd-analyze", {"security", "--offline=true", "--no-pager", unit});
    ASSERT_EQ(security.wait(seconds(30)), 0) << unit << security.output();
    const std::string said = security.output();
    std::smatch found;
    ASSERT_TRUE(std::regex_search(said, found, std::regex("exposure level for [^ ]+: ([0-9.]+) "))) << said;
    EXPECT_LT(std::stod(found[1]), 3.0) << said;
  }
}

}  // namespace hardened_test
}  // namespace inslab::e2e
