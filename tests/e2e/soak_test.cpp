#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace soak_test {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;

std::vector<std::string> soak(std::vector<std::string> more) {
  more.insert(more.begin(), {"soak", source("config/scenarios/soak.json"), "--domain", own_domain()});
  return more;
}

/// Some in every test run, 24 hours with two busy threads beside them where INSLAB_SOAK_HOURS=24 INSLAB_SOAK_LOAD=2 ask
/// for them.
std::string asked(const char* variable, const char* otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr ? otherwise : value;
}

// It kills at the beginning and at the end, and on the way one, two at once, and one that is just told of a swap.
TEST(Soak, OfAFewMinutesWithSwapsKillsAndPausesHolds) {
  const TestFolder folder;
  const std::string hours = asked("INSLAB_SOAK_HOURS", "0.1");
  Process run("inslab", soak({"--hours", hours, "--seed", "5", "--often", hours == "0.1" ? "10" : "1", "--load",
                              asked("INSLAB_SOAK_LOAD", "0"), "--log", folder / "soak.mcap"}));
  EXPECT_EQ(run.wait(std::chrono::hours(hours == "0.1" ? 0 : 24) + seconds(180)), 0) << run.output();
  EXPECT_THAT(run.output(), ContainsRegex("h of sim time in .*: [1-9][0-9]* swaps, [1-9][0-9]* kills, [0-9]+ pauses"));
  EXPECT_THAT(run.output(), HasSubstr("everything held"));
  EXPECT_FALSE(std::filesystem::exists(folder / "soak.mcap"));
}

TEST(Soak, WithoutProfilesToSwapToIsRefusedByTheFolder) {
  const TestFolder folder;
  Process run("inslab", soak({"--hours", "1", "--profiles", folder / "none"}));
  EXPECT_EQ(run.wait(seconds(30)), 2);
  EXPECT_THAT(run.output(), HasSubstr("none/imu: has no profiles *.json; --profiles names the folder"));
}

TEST(Soak, LongerThanItsScenarioIsRefused) {
  Process run("inslab", soak({"--hours", "25"}));
  EXPECT_EQ(run.wait(seconds(30)), 2);
  EXPECT_THAT(run.output(), HasSubstr("lasts 24 h; 25 h were asked for"));
}

}  // namespace soak_test
}  // namespace inslab::e2e
