#include "inslab/scenario/document_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "inslab/data/json/config_error.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::scenario {
namespace document_kind_test {

using ::testing::HasSubstr;

const std::filesystem::path kConfig = std::filesystem::path(INSLAB_SOURCE_DIR) / "config";

/// With and without the schema that a file names.
void expect_all(const std::string& folder, DocumentKind kind) {
  for (const auto& entry : std::filesystem::directory_iterator(kConfig / folder)) {
    if (entry.path().extension() != ".json") continue;
    json::Json json = json::read_json_file(entry.path());
    if (json.contains("$schema")) {
      EXPECT_EQ(document_kind(json), kind) << entry.path();
    }
    json.erase("$schema");
    const bool is_name_alone = json.size() == 2 && json.contains("name") && json.contains("source");
    EXPECT_EQ(document_kind(json), is_name_alone ? std::nullopt : std::optional(kind))
        << entry.path() << " without its schema";
  }
}

TEST(DocumentKind, OfEveryFileThatComesWithInslabIsKnown) {
  expect_all("scenarios", DocumentKind::Scenario);
  expect_all("profiles/imu", document_of(ProfileKind::ImuError));
  expect_all("profiles/vibration", document_of(ProfileKind::Vibration));
  expect_all("profiles/installation", document_of(ProfileKind::Installation));
  expect_all("profiles/gnss", document_of(ProfileKind::GnssError));
  expect_all("profiles/fault", document_of(ProfileKind::Fault));
  expect_all("nav", DocumentKind::Navigation);
  expect_all("lab", DocumentKind::Inventory);
}

TEST(DocumentKind, AScheduleIsNoScenario) {
  EXPECT_EQ(document_kind(json::parse_json(R"({"swaps": []})", "f")), DocumentKind::Schedule);
}

TEST(DocumentKind, OfWhatIsNotOursIsNone) {
  EXPECT_EQ(document_kind(json::parse_json(R"({"name": "x", "other": 1})", "f")), std::nullopt);
  EXPECT_EQ(document_kind(json::parse_json("[1, 2]", "f")), std::nullopt);
}

std::string refusal_of_profile(const std::string& file, ProfileKind kind) {
  try {
    load_profile(kConfig / file, kind, {SensorKind::Imu, 0});
  } catch (const json::Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DocumentKind, AFileOfAnotherKindIsCalledWhatItIs) {
  EXPECT_THAT(refusal_of_profile("profiles/gnss/rtk.json", ProfileKind::ImuError),
              HasSubstr("rtk.json: is a GNSS error profile (gnss_error); expected an IMU error profile (imu_error)"));
  EXPECT_THAT(refusal_of_profile("scenarios/demo.json", ProfileKind::Vibration),
              HasSubstr("demo.json: is a scenario; expected a vibration profile"));
  try {
    load(kConfig / "profiles/imu/stim300.json");
    FAIL();
  } catch (const json::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("is an IMU error profile (imu_error); expected a scenario"));
  }
  try {
    navigation::read_parameters((kConfig / "scenarios/demo.json").string());
    FAIL();
  } catch (const json::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("is a scenario; expected a navigation filter's parameters"));
  }
}

TEST(ProfileKindWords, AreThoseOfScenariosAndTwoShortOnes) {
  EXPECT_EQ(profile_kind_named("imu_error"), ProfileKind::ImuError);
  EXPECT_EQ(profile_kind_named("imu"), ProfileKind::ImuError);
  EXPECT_EQ(profile_kind_named("gnss"), ProfileKind::GnssError);
  EXPECT_EQ(profile_kind_named("wheel"), std::nullopt);
  for (const std::string& word : profile_kind_words()) EXPECT_TRUE(profile_kind_named(word)) << word;
}

}  // namespace document_kind_test
}  // namespace inslab::scenario
