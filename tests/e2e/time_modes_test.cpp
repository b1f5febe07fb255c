#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace time_modes_test {

using std::chrono::seconds;
using testing::HasSubstr;

/// One scenario with its schedule of swaps, offline once and live in one mode after the other.
class TimeModes : public testing::Test {
 protected:
  void SetUp() override {
    Process offline("inslab", {"simulate", scenario_, "-o", folder_ / "offline"});
    ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  }
  std::unique_ptr<Process> live(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"run", scenario_, "--log", log_, "--domain", own_domain()};
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Process>("inslab", all);
  }
  /// A command to the running set; its exit code and what it printed.
  std::pair<int, std::string> command(std::vector<std::string> words) const {
    words.insert(words.end(), {"--domain", own_domain()});
    Process asking("inslab", words);
    const int code = asking.wait(seconds(20)).value_or(-1);
    return {code, asking.output()};
  }
  std::size_t truth_logged() const { return samples_of<TruthState>(log_, "inslab/truth").size(); }

  TestFolder folder_;
  std::string scenario_ = source("tests/data/short.json");
  std::string log_ = folder_ / "live.mcap";
  std::string reference_ = folder_ / "offline/short.mcap";
};

TEST_F(TimeModes, FiveTimesRealTimeGivesTheBitsOfTheOfflineRun) {
  const auto run = live({"--rate", "5"});
  ASSERT_EQ(run->wait(seconds(60)), 0) << run->output();
  expect_same_run(log_, reference_);
}

TEST_F(TimeModes, LockstepGivesTheBitsOfTheOfflineRun) {
  const auto run = live({"--clock", "lockstep"});
  ASSERT_EQ(run->wait(seconds(60)), 0) << run->output();
  expect_same_run(log_, reference_);
}

TEST_F(TimeModes, AtRatesThatDivideNoneOfTheOthersLockstepGivesThemToo) {
  const std::string odd = source("tests/data/odd_rates.json");
  Process offline("inslab", {"simulate", odd, "-o", folder_ / "odd"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  Process run("inslab", {"run", odd, "--log", log_, "--domain", own_domain(), "--clock", "lockstep"});
  ASSERT_EQ(run.wait(seconds(60)), 0) << run.output();
  expect_same_odd_run(log_, folder_ / "odd/odd_rates.mcap");
}

TEST_F(TimeModes, LockstepOverSharedMemoryGivesThemToo) {
  const auto run = live({"--clock", "lockstep", "--transport", "shm"});
  ASSERT_EQ(run->wait(seconds(60)), 0) << run->output();
  expect_same_run(log_, reference_);
}

TEST_F(TimeModes, PausesStepsAndChangesOfRateChangeNoBit) {
  const auto run = live();
  ASSERT_TRUE(run->prints("short: 1", seconds(30))) << run->output();
  const auto [paused, said] = command({"pause"});
  ASSERT_EQ(paused, 0) << said;
  EXPECT_THAT(said, HasSubstr("paused at "));
  EXPECT_EQ(command({"step", "120"}).first, 0);
  EXPECT_TRUE(eventually([&] { return command({"step", "30"}).first == 0; }, seconds(20)));
  EXPECT_EQ(command({"rate", "3"}).first, 0);
  EXPECT_EQ(command({"resume"}).first, 0);
  ASSERT_EQ(run->wait(seconds(60)), 0) << run->output();
  expect_same_run(log_, reference_);
}

TEST_F(TimeModes, ARunThatStartsPausedSendsTheStepsAskedForAndNoMore) {
  const auto run = live({"--paused"});
  const auto stepped = [&] { return command({"step", "50"}); };
  ASSERT_TRUE(eventually([&] { return stepped().first == 0; }, seconds(40))) << run->output();
  EXPECT_EQ(command({"step", "0"}).first, 3);
  const auto paused_after_fifty = [&] {
    const std::string status = command({"status"}).second;
    return status.find("short paused") != std::string::npos && status.find(" 50 truth samples") != std::string::npos;
  };
  EXPECT_TRUE(eventually(paused_after_fifty, seconds(20)));
  EXPECT_EQ(command({"stop"}).first, 0);
  run->wait(seconds(30));
  EXPECT_EQ(truth_logged(), 50U);
}

TEST_F(TimeModes, RefusedCommandsSayWhyAndExitWithThree) {
  const auto run = live();
  ASSERT_TRUE(run->prints("short: 1", seconds(30))) << run->output();
  const auto [code, said] = command({"step", "5"});
  EXPECT_EQ(code, 3);
  EXPECT_THAT(said, HasSubstr("refused: a step needs a paused run"));
  EXPECT_EQ(command({"rate", "5000"}).first, 3);
  EXPECT_EQ(run->wait(seconds(60)), 0) << run->output();
}

}  // namespace time_modes_test
}  // namespace inslab::e2e
