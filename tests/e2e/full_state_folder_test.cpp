// A run whose services find no room for what they would need to go on after a kill.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace full_state_folder_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

class FullStateFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(state_);
    Process disk("unshare", {"-rm", "mount", "-t", "tmpfs", "tmpfs", state_});
    if (disk.wait(seconds(10)) != 0) GTEST_SKIP() << "this user may not mount a small disk of its own";
    Process offline("inslab", {"simulate", scenario_, "-o", folder_ / "offline"});
    ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  }
  /// `inslab run` whose services keep their states on a disk of its own, on which `first` is done before.
  std::unique_ptr<Process> run(const std::string& options, const std::string& first) const {
    const std::string command = "mount -t tmpfs -o " + options + " tmpfs " + state_ + " && " + first +
                                "; XDG_RUNTIME_DIR=" + state_ + " exec " + program("inslab") + " run " + scenario_ +
                                " --log " + log_ + " --domain " + own_domain();
    return std::make_unique<Process>("unshare", std::vector<std::string>{"-rm", "sh", "-c", command});
  }

  const TestFolder folder_;
  const std::string state_ = folder_ / "state";
  const std::string log_ = folder_ / "live.mcap";
  const std::string scenario_ = source("tests/data/short.json");
};

TEST_F(FullStateFolder, CostsTheRunNothingAndIsSaidByEachService) {
  const auto set = run("size=64k", "head -c 64k /dev/zero > " + state_ + "/filled 2>/dev/null");
  EXPECT_EQ(set->wait(seconds(60)), 0) << set->output();
  EXPECT_THAT(set->output(), HasSubstr("started again in the middle of a run, this service could not go on: "));
  EXPECT_THAT(set->output(), HasSubstr("No space left on device"));
  EXPECT_THAT(set->output(), HasSubstr("killed, this service would lose what it has not written yet: "));
  expect_same_run(log_, folder_ / "offline/short.mcap");
}

TEST_F(FullStateFolder, ThatCannotBeWrittenToIsTheSame) {
  const auto set = run("ro", "true");
  EXPECT_EQ(set->wait(seconds(60)), 0) << set->output();
  EXPECT_THAT(set->output(), HasSubstr("Read-only file system"));
  expect_same_run(log_, folder_ / "offline/short.mcap");
}

/// What it lacks is still with the trajectory server, so early in a run.
TEST_F(FullStateFolder, AServiceThatIsKilledBeginsAnewWhileTheTruthIsThereAndIsNotSilentAboutIt) {
  const auto set = run("size=64k", "head -c 64k /dev/zero > " + state_ + "/filled 2>/dev/null");
  ASSERT_TRUE(set->prints("short: 2", seconds(60))) << set->output();
  const auto injectors = children_named(set->pid(), "inslab-imu-injector");
  ASSERT_FALSE(injectors.empty());
  kill(injectors.front(), SIGKILL);
  const auto code = set->wait(seconds(60));
  ASSERT_TRUE(code.has_value()) << set->output();
  EXPECT_THAT(set->output(), HasSubstr("was ended by signal 9 (Killed) and started again"));
  if (*code == 0) {
    expect_same_run(log_, folder_ / "offline/short.mcap");
  } else {
    EXPECT_THAT(set->output(), HasSubstr("cannot be had"));
  }
}

TEST_F(FullStateFolder, ThatFillsInMidRunKeepsTheStatesThatHadTheirRoom) {
  const auto set = run("size=64m", "true");
  ASSERT_TRUE(set->prints("short: 1", seconds(60))) << set->output();
  Process filled("nsenter", {"-t", std::to_string(set->pid()), "-U", "-m", "--preserve-credentials", "sh", "-c",
                             "head -c 64m /dev/zero > " + state_ + "/filled"});
  ASSERT_TRUE(filled.wait(seconds(20)).has_value());
  EXPECT_THAT(filled.output(), HasSubstr("No space left"));
  const auto injectors = children_named(set->pid(), "inslab-imu-injector");
  ASSERT_FALSE(injectors.empty());
  kill(injectors.front(), SIGKILL);
  EXPECT_EQ(set->wait(seconds(60)), 0) << set->output();
  EXPECT_THAT(set->output(), HasSubstr("recovered: inslab/imu/"));
  expect_same_run(log_, folder_ / "offline/short.mcap");
}

}  // namespace full_state_folder_test
}  // namespace inslab::e2e
