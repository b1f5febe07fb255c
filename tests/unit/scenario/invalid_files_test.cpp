#include "tests/unit/scenario/invalid_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/data/json/json_reader.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/scenario/load.hpp"

/// config/invalid holds files that break one rule each, and expected.json what must be said of them.
namespace inslab::scenario {
namespace invalid_files_test {

const std::filesystem::path kFolder = std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "invalid";

const std::vector<test::InvalidFile>& invalid_files() {
  static const auto all = json::read_file<test::InvalidFiles>(kFolder / "expected.json");
  return all.files;
}

void load_any(const test::InvalidFile& expected) {
  const std::filesystem::path file = kFolder / expected.file;
  if (expected.kind == "scenario") {
    load(file);
  } else if (expected.kind == "navigation") {
    navigation::read_parameters(file.string());
  } else {
    const auto& names = EnumNames<ProfileKind>::values;
    const auto name = std::find(names.begin(), names.end(), expected.kind);
    ASSERT_NE(name, names.end()) << expected.file << " is said to be of the kind " << expected.kind;
    const auto kind = static_cast<ProfileKind>(name - names.begin());
    load_profile(file, kind, {expected.sensor_kind.value_or(catalog::usual_sensor(kind)), 0});
  }
}

TEST(InvalidFiles, AreEachRefusedByTheirRuleWithFilePathAndReason) {
  for (const test::InvalidFile& expected : invalid_files()) {
    try {
      load_any(expected);
      ADD_FAILURE() << expected.file << " was accepted";
    } catch (const json::Error& error) {
      const std::string& at_fault = expected.reported_file.empty() ? expected.file : expected.reported_file;
      EXPECT_EQ(error.file(), (kFolder / at_fault).string());
      EXPECT_EQ(enum_name(error.rule()), enum_name(expected.rule)) << error.what();
      EXPECT_EQ(error.path(), expected.path) << error.what();
      EXPECT_EQ(error.reason().substr(0, expected.reason.size()), expected.reason) << error.what();
    }
  }
}

TEST(InvalidFiles, ThereIsOneForEveryRule) {
  std::set<Rule> shown;
  for (const test::InvalidFile& file : invalid_files()) shown.insert(file.rule);
  for (std::size_t i = 0; i < EnumNames<Rule>::values.size(); ++i) {
    const auto rule = static_cast<Rule>(i);
    if (is_for_requests_only(rule)) continue;
    EXPECT_EQ(shown.count(rule), 1U) << "config/invalid has no file that breaks the rule " << enum_name(rule);
  }
}

TEST(InvalidFiles, AreAllListed) {
  std::set<std::string> listed{"expected.json"};
  std::set<std::string> reported;  // the rows of trajectories, which scenarios name
  for (const test::InvalidFile& file : invalid_files()) {
    EXPECT_TRUE(listed.insert(file.file).second) << file.file << " is listed twice";
    reported.insert(file.reported_file);
  }
  for (const test::InvalidFile& file : invalid_files()) listed.insert(file.reported_file);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(listed.count(name) + reported.count(name) > 0) << entry.path() << " is not in expected.json";
  }
}

TEST(Scenario, RefusesASensorItDoesNotHave) {
  const auto loaded = load(std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "scenarios" / "demo.json");
  EXPECT_EQ(loaded.sensor<catalog::Imu>(0).number, 0U);
  EXPECT_THROW(loaded.sensor<catalog::Imu>(7), json::Error);
  EXPECT_THROW(loaded.sensor<catalog::Gnss>(7), json::Error);
}

}  // namespace invalid_files_test
}  // namespace inslab::scenario
