#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;

std::vector<std::string> soak(std::vector<std::string> more) {
  more.insert(more.begin(), {"soak", source("config/scenarios/soak.json"), "--profiles", source("config/profiles"),
                             "--domain", own_domain()});
  return more;
}

// With seed 5 the first kill comes early.
TEST(Soak, OfAFewMinutesWithSwapsKillsAndPausesHolds) {
  const TestFolder folder;
  Process run("inslab", soak({"--hours", "0.1", "--seed", "5", "--log", folder / "soak.mcap"}));
  EXPECT_EQ(run.wait(seconds(180)), 0) << run.output();
  EXPECT_THAT(run.output(),
              ContainsRegex("0\\.10 h of sim time in .*: [0-9]+ swaps, [1-9][0-9]* kills, [0-9]+ pauses"));
  EXPECT_THAT(run.output(), HasSubstr("everything held"));
  EXPECT_FALSE(std::filesystem::exists(folder / "soak.mcap"));
}

TEST(Soak, LongerThanItsScenarioIsRefused) {
  Process run("inslab", soak({"--hours", "25"}));
  EXPECT_EQ(run.wait(seconds(30)), 2);
  EXPECT_THAT(run.output(), HasSubstr("lasts 24 h; 25 h were asked for"));
}

}  // namespace
}  // namespace inslab::e2e
