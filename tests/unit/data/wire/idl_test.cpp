#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/idl_text.hpp"

namespace inslab::wire {
namespace idl_test {

TEST(SelfContainedIdl, HasNoPreprocessorLineAndTheTypesItNeeds) {
  const std::string text = self_contained_idl(catalog::WireType<ImuSample>::idl_file);
  EXPECT_EQ(text.find("#include"), std::string::npos);
  EXPECT_EQ(text.find("\n#"), std::string::npos);
  const std::size_t header = text.find("struct StreamHeader");
  const std::size_t sample = text.find("struct ImuSample");
  ASSERT_NE(header, std::string::npos);
  ASSERT_NE(sample, std::string::npos);
  EXPECT_LT(header, sample);
}

TEST(SelfContainedIdl, RefusesAFileThatIsNotThere) { EXPECT_THROW(self_contained_idl("no.idl"), std::out_of_range); }

/// FNV-1a, 64 bits.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3u;
  return hash;
}

/// A file's declarations alone: no comments, no preprocessor lines, no spaces, no names of modules.
std::string declarations_of(const std::string& idl_file) {
  std::istringstream lines(self_contained_idl(idl_file));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("module ", 0) == 0) continue;
    line.erase(line.find("//") == std::string::npos ? line.size() : line.find("//"));
    for (const char c : line) {
      if (c != ' ') text += c;
    }
  }
  return text;
}

TEST(WireVersion, GoesUpWhenAStructOrAnEnumerationChanges) {
  // Of each version, in order: the declarations as they are on the wire.
  const std::map<std::string, std::uint64_t> versions{{"inslab::v1::", 0xfbec7fd78ba1b314},
                                                      {"inslab::v2::", 0x94c6006dc09440dd},
                                                      {"inslab::v3::", 0xb6689a7b9d45a77d},
                                                      {"inslab::v4::", 0xd6818a7c178775f0},
                                                      {"inslab::v5::", 0x50f5681fd9f11ff6}};
  std::string all;
  for (const char* file : {"block.idl", "control.idl", "vehicle.idl"}) all += declarations_of(file);
  ASSERT_EQ(versions.count(std::string(catalog::kModule)), 1u);
  EXPECT_EQ(hash_of(all), versions.at(std::string(catalog::kModule)))
      << "the types are not those of " << catalog::kModule
      << ". Give idl/ and wire_type.hpp the next version, add it here with "
      << "this hash, and keep logs of the versions before readable (wire::present_name())";
}

TEST(WireVersion, StandsInEveryFile) {
  for (const auto& entry : std::filesystem::directory_iterator(INSLAB_SOURCE_DIR "/idl")) {
    if (entry.path().extension() != ".idl") continue;
    const std::string file = entry.path().filename();
    std::istringstream lines(self_contained_idl(file));
    int modules = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("module ", 0) != 0) continue;
      ++modules;
      EXPECT_EQ(line, "module inslab { module v5 {") << file;
    }
    EXPECT_GT(modules, 0) << file;
  }
  EXPECT_EQ(catalog::kModule, "inslab::v5::");
}

TEST(PresentName, IsThatOfTheSameTypeInAnEarlierLog) {
  EXPECT_EQ(present_name("inslab::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v1::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v2::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v3::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v4::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v5::TruthState"), catalog::WireType<TruthState>::name);
  EXPECT_EQ(present_name("inslab::v7::TruthState"),
            "inslab::v7::TruthState");  // read as one it would be read wrong
  EXPECT_EQ(present_name("sensor_msgs::msg::Imu"), "sensor_msgs::msg::Imu");
}

/// Whoever builds a client begins with the first page.
TEST(TypeNames, OfTheFirstPageAreThoseOfThePresentVersion) {
  std::ifstream file(INSLAB_SOURCE_DIR "/README.md");
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string module = std::string(catalog::kModule).substr(0, std::string(catalog::kModule).rfind("::"));
  std::size_t names = 0;
  for (std::size_t at = page.find("inslab::v"); at != std::string::npos; at = page.find("inslab::v", at + 1)) {
    EXPECT_EQ(page.substr(at, module.size()), module) << page.substr(at, 40);
    ++names;
  }
  EXPECT_GT(names, 10u);
}

TEST(TopicNames, AreOneForEachStreamAndKind) {
  EXPECT_EQ(catalog::stream_topic<ImuSample>(3), "inslab/imu/3");
  EXPECT_EQ(catalog::stream_topic<ImuTruth>(0), "inslab/imu_truth/0");
  EXPECT_EQ(catalog::stream_topic<GnssFix>(1), "inslab/gnss/1");
  EXPECT_EQ(catalog::request_topic(ProfileKind::GnssError), "inslab/profile/gnss_error");
  EXPECT_EQ(catalog::journal_topic(ProfileKind::ImuError), "inslab/journal/imu_error");
}

}  // namespace idl_test
}  // namespace inslab::wire
