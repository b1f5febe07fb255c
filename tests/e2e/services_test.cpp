#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace services_test {

using std::chrono::seconds;
using testing::HasSubstr;

/// The four kinds of process, started by hand.
class Services : public testing::Test {
 protected:
  std::vector<std::string> arguments(std::initializer_list<std::string> more = {}) const {
    std::vector<std::string> all{"--scenario", source("tests/data/short.json"), "--domain", own_domain()};
    all.insert(all.end(), more);
    return all;
  }
  std::unique_ptr<Process> server() const { return std::make_unique<Process>("inslab-trajectory-server", arguments()); }
  std::unique_ptr<Process> injector(const std::string& sensor) const {
    return std::make_unique<Process>("inslab-imu-injector", arguments({"--sensor", sensor}));
  }
  std::unique_ptr<Process> emulator() const { return std::make_unique<Process>("inslab-gnss-emulator", arguments()); }
  std::unique_ptr<Process> logger(const Process::Limits& limits = {}) const {
    return std::make_unique<Process>("inslab-truth-logger", arguments({"--log", log_}), limits);
  }
  /// Waits until samples are in the log.
  bool running() const {
    return eventually([this] { return logged() > 0; }, seconds(20));
  }
  std::size_t logged() const {
    try {
      return samples_of<TruthState>(log_, "inslab/truth").size();
    } catch (const std::exception&) {
      return 0;
    }
  }

  TestFolder folder_;
  std::string log_ = folder_ / "log.mcap";
};

TEST_F(Services, ThatAreNotBuiltAreNamedWithWhatBuildsThem) {
  std::filesystem::copy_file(program("inslab"), folder_ / "inslab");
  Process run(folder_ / "inslab",
              {"run", source("tests/data/short.json"), "--domain", own_domain(), "--log", folder_ / "run.mcap"});
  EXPECT_EQ(run.wait(seconds(60)), 1) << run.output();
  EXPECT_THAT(run.output(), HasSubstr(folder_ / "inslab-truth-logger" + ": No such file or directory"));
  EXPECT_THAT(run.output(), HasSubstr("cmake --build --preset release --target live_set sensors"));
}

TEST_F(Services, StartInAnyOrderAndEndTogether) {
  const auto gnss = emulator();
  const auto truth = server();
  const auto imu3 = injector("3");
  const auto log = logger();
  const auto imu0 = injector("0");
  EXPECT_EQ(truth->wait(seconds(60)), 0) << truth->output();
  for (Process* process : {gnss.get(), imu3.get(), imu0.get(), log.get()}) {
    EXPECT_EQ(process->wait(seconds(20)), 0) << process->output();
  }
  EXPECT_EQ(samples_of<TruthState>(log_, "inslab/truth").size(), 1601u);
  EXPECT_EQ(samples_of<ImuSample>(log_, "inslab/imu/0").size(), 1600u);
}

TEST_F(Services, KilledInjectorTakesNobodyDownAndStatusNamesIt) {
  const auto log = logger();
  const auto imu0 = injector("0");
  const auto imu3 = injector("3");
  const auto gnss = emulator();
  const auto truth = server();
  ASSERT_TRUE(running()) << truth->output();
  imu0->send(SIGKILL);
  ASSERT_EQ(imu0->wait(seconds(5)), 128 + SIGKILL);

  const auto asked = std::chrono::steady_clock::now();
  Process asking("inslab", {"status", source("tests/data/short.json"), "--domain", own_domain()});
  EXPECT_EQ(asking.wait(seconds(10)), 1) << asking.output();
  EXPECT_LT(std::chrono::steady_clock::now() - asked, seconds(3));
  EXPECT_THAT(asking.output(), testing::ContainsRegex("inslab-imu-injector +0  MISSING"));
  EXPECT_THAT(asking.output(), testing::ContainsRegex("inslab-imu-injector +3  running"));

  EXPECT_EQ(truth->wait(seconds(60)), 0) << truth->output();
  EXPECT_EQ(gnss->wait(seconds(20)), 0) << gnss->output();
  EXPECT_EQ(imu3->wait(seconds(20)), 0) << imu3->output();
  EXPECT_EQ(log->wait(seconds(20)), 1) << log->output();  // it says that samples are missing
  EXPECT_EQ(samples_of<TruthState>(log_, "inslab/truth").size(), 1601u);
  EXPECT_EQ(samples_of<ImuSample>(log_, "inslab/imu/3").size(), 400u);
}

TEST_F(Services, TerminatedLoggerClosesItsLog) {
  const auto log = logger();
  const auto imu0 = injector("0");
  const auto imu3 = injector("3");
  const auto gnss = emulator();
  const auto truth = server();
  ASSERT_TRUE(running()) << truth->output();
  log->send(SIGTERM);
  EXPECT_EQ(log->wait(seconds(20)), 1) << log->output();  // it left a run
  EXPECT_THAT(log->output(), HasSubstr("ended by a signal in mid-run: the rest is missing"));
  EXPECT_TRUE(mcap::McapReader(log_).closed_properly());
  EXPECT_EQ(truth->wait(seconds(30)), 0) << truth->output();
}

TEST_F(Services, KilledLoggerLeavesALogUpToTheLastSecond) {
  const auto log = logger();
  const auto imu0 = injector("0");
  const auto imu3 = injector("3");
  const auto gnss = emulator();
  const auto truth = server();
  ASSERT_TRUE(eventually([this] { return logged() > 400; }, seconds(20))) << truth->output();
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(5)), 128 + SIGKILL);
  const mcap::McapReader left(log_);
  EXPECT_FALSE(left.closed_properly());
  // 2 s were there when it was killed; at most one more second may be missing from what it had by then.
  const auto samples = samples_of<TruthState>(log_, "inslab/truth");
  EXPECT_GE(samples.size(), 400u);
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i].header.sequence_number, i);
  EXPECT_EQ(truth->wait(seconds(60)), 0) << truth->output();
}

TEST_F(Services, FullDiskIsSaidAndStopsNoStream) {
  Process::Limits limits;
  limits.file_size_bytes = 1'000'000;  // what describes the streams is two fifths of that
  const auto log = logger(limits);
  const auto imu0 = injector("0");
  const auto imu3 = injector("3");
  const auto gnss = emulator();
  const auto truth = server();
  ASSERT_TRUE(log->prints("cannot write: File too large", seconds(30))) << log->output() << truth->output();
  Process asking("inslab", {"status", source("tests/data/short.json"), "--domain", own_domain()});
  EXPECT_EQ(asking.wait(seconds(10)), 0) << asking.output();
  EXPECT_THAT(asking.output(), testing::ContainsRegex("inslab-truth-logger +0  fault .*File too large"));
  EXPECT_EQ(truth->wait(seconds(30)), 0) << truth->output();
  EXPECT_EQ(imu0->wait(seconds(20)), 0) << imu0->output();
  EXPECT_EQ(gnss->wait(seconds(20)), 0) << gnss->output();
  EXPECT_EQ(log->wait(seconds(20)), 1) << log->output();
  EXPECT_GT(samples_of<TruthState>(log_, "inslab/truth").size(), 100u);
}

TEST_F(Services, BarrierNamesWhoIsMissing) {
  Process alone("inslab-trajectory-server",
                {"--scenario", source("tests/data/impatient.json"), "--domain", own_domain()});
  EXPECT_EQ(alone.wait(seconds(20)), 1);
  EXPECT_THAT(alone.output(), HasSubstr("inslab-imu-injector (sensor 0)"));
  EXPECT_THAT(alone.output(), HasSubstr("inslab-truth-logger (sensor 0)"));
}

TEST_F(Services, SwapByHandIsAcknowledgedOrRejectedWithItsField) {
  const auto log = logger();
  const auto imu0 = injector("0");
  const auto imu3 = injector("3");
  const auto gnss = emulator();
  const auto truth = server();
  ASSERT_TRUE(running()) << truth->output();
  const auto swap = [](std::vector<std::string> more) {
    more.insert(more.begin(), "swap");
    more.insert(more.end(), {"--domain", own_domain()});
    return std::make_unique<Process>("inslab", more);
  };
  const auto good = swap({"imu", source("config/profiles/imu/pos830.json"), "--sensor", "3", "--at", "7"});
  const auto stranger = swap({"imu", source("config/profiles/imu/pos830.json"), "--sensor", "5"});
  EXPECT_EQ(stranger->wait(seconds(15)), 3);
  EXPECT_THAT(stranger->output(), HasSubstr("rejected: target_number: names imu5"));
  EXPECT_EQ(good->wait(seconds(15)), 0) << good->output();
  EXPECT_THAT(good->output(), HasSubstr("applied at 7.000000000 s; first sample under it 7.020000000 s, sequence 350"));
  EXPECT_EQ(truth->wait(seconds(30)), 0) << truth->output();
}

}  // namespace services_test
}  // namespace inslab::e2e
