#include <gtest/gtest.h>

#include <filesystem>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/json/json_writer.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/scenario/load.hpp"
#include "tests/unit/foundation/fields/field_bits.hpp"

/// The scenarios and profiles that come with the product.
namespace inslab::scenario {
namespace valid_files_test {

const std::filesystem::path kConfig = std::filesystem::path(INSLAB_SOURCE_DIR) / "config";

std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  return files;
}

/// Empty when the file names no schema.
std::string schema_named_in(const std::filesystem::path& file) {
  const json::Json json = json::read_json_file(file);
  return json.contains("$schema") ? json.at("$schema").get<std::string>() : "";
}

void expect_schema(const std::filesystem::path& file, const std::string& schema) {
  const std::filesystem::path named = (file.parent_path() / schema_named_in(file)).lexically_normal();
  EXPECT_EQ(named, kConfig / "schema" / schema) << file;
  EXPECT_TRUE(std::filesystem::is_regular_file(named)) << file;
}

template <class T>
void expect_round_trip(const T& value, const std::filesystem::path& file) {
  const T back = json::struct_from_json<T>(json::parse_json(json::json_from_struct(value).dump(), "again"), "again");
  EXPECT_EQ(test::bits_of(back), test::bits_of(value)) << file;
}

TEST(ValidFiles, EveryScenarioLoadsNamesItsSchemaAndSurvivesARoundTrip) {
  const auto files = json_files(kConfig / "scenarios");
  EXPECT_GE(files.size(), 2U);
  for (const auto& file : files) {
    EXPECT_NO_THROW({
      const LoadedScenario loaded = load(file);
      expect_round_trip(loaded.scenario, file);
    });
    expect_schema(file, "scenario.schema.json");
  }
}

template <class Profile>
void expect_good_profiles(const std::string& folder, const std::string& schema) {
  for (const auto& file : json_files(kConfig / "profiles" / folder)) {
    EXPECT_NO_THROW({ expect_round_trip(json::read_file<Profile>(file), file); });
    if (!schema_named_in(file).empty()) expect_schema(file, schema);
  }
}

TEST(ValidFiles, EveryProfileReadsAndSurvivesARoundTrip) {
  EXPECT_GE(json_files(kConfig / "profiles").size(), 10U);
  expect_good_profiles<ImuErrorProfile>("imu", "imu_error.schema.json");
  expect_good_profiles<VibrationProfile>("vibration", "vibration.schema.json");
  expect_good_profiles<InstallationProfile>("installation", "installation.schema.json");
  expect_good_profiles<GnssErrorProfile>("gnss", "gnss_error.schema.json");
  expect_good_profiles<FaultProfile>("fault", "fault.schema.json");
}

TEST(ValidFiles, EveryFilterReadsAndSurvivesARoundTrip) {
  const auto files = json_files(kConfig / "nav");
  EXPECT_GE(files.size(), 1U);
  for (const auto& file : files) {
    EXPECT_NO_THROW({ expect_round_trip(navigation::read_parameters(file.string()), file); });
    expect_schema(file, "navigation.schema.json");
  }
}

}  // namespace valid_files_test
}  // namespace inslab::scenario
