// A logger that is killed while the app goes on answering.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "inslab/bus/dds/writer.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/running_set.hpp"

namespace inslab::e2e {
namespace killed_logger_test {

using std::chrono::seconds;
using testing::HasSubstr;

class KilledLogger : public RunningSet {
 protected:
  std::vector<NavSolution> solutions() const { return samples_of_kind<NavSolution>(log_, "inslab/nav"); }
  std::set<std::uint64_t> answered() const {
    std::set<std::uint64_t> sequences;
    for (const NavSolution& solution : solutions()) sequences.insert(solution.imu_sequence);
    return sequences;
  }
  /// What the log says of the messages of a topic that it lacks; empty: nothing.
  std::string missing(const std::string& topic) const {
    const mcap::McapReader log(log_);
    for (const mcap::Metadata& record : log.metadata()) {
      if (record.values.count("missing_messages") > 0 && record.values.at("what") == topic) {
        return record.values.at("missing_messages");
      }
    }
    return "";
  }
};

TEST_F(KilledLogger, HasEverySolutionThatCameMeanwhileOnceAndSaysSo) {
  Process run("inslab", {"run", scenario("reference_nav"), "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(reaches(4.0)) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_TRUE(run.wait(seconds(90))) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("recovered: inslab/nav: 0 messages that were sent while the logger was away are "
                                      "missing"));
  EXPECT_EQ(solutions().size(), 2000u);
  EXPECT_EQ(answered().size(), 2000u);
  EXPECT_EQ(missing("inslab/nav"), "0");
}

TEST_F(KilledLogger, HasTheSolutionsThatCameMeanwhileInLockstepToo) {
  Process run("inslab",
              {"run", scenario("reference_nav_long"), "--domain", own_domain(), "--log", log_, "--clock", "lockstep"});
  ASSERT_TRUE(reaches(30.0)) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_TRUE(run.wait(seconds(120))) << run.output();
  EXPECT_EQ(solutions().size(), 60'000u);
  EXPECT_EQ(answered().size(), 60'000u);
  EXPECT_EQ(missing("inslab/block/nav"), "0");
}

/// The app is one that keeps nothing: its writer is volatile.
TEST_F(KilledLogger, SaysHowManySolutionsItLacksOfAnAppThatKeepsNone) {
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_long", {"--log", log_}); };
  auto log = logger();
  const auto imu = service("inslab-imu-injector", "recovery_long");
  const auto gnss = service("inslab-gnss-emulator", "recovery_long");
  const auto truth = service("inslab-trajectory-server", "recovery_long", {"--clock", "real_time", "--rate", "1"});
  dds::Writer<NavSolution> app(participant_, dds::topics::nav());
  NavSolution solution;
  const auto answer = [&] {
    EXPECT_TRUE(app.write(solution));
    ++solution.imu_sequence;
  };
  ASSERT_TRUE(reaches(1.0)) << truth->output();
  ASSERT_TRUE(eventually([&] { return app.matched_readers() > 0; }, seconds(20)));
  for (int i = 0; i < 10; ++i) answer();
  ASSERT_TRUE(app.wait_for_acknowledgments(seconds(10)));
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  for (int i = 0; i < 7; ++i) answer();
  log = logger();
  EXPECT_TRUE(eventually(
      [&] {
        answer();
        return log->output().find("inslab/nav: ") != std::string::npos;
      },
      seconds(60)))
      << log->output();
  truth->send(SIGTERM);
  EXPECT_TRUE(log->wait(seconds(60))) << log->output();
  const std::set<std::uint64_t> logged = answered();
  const std::uint64_t lacks = *logged.rbegin() + 1 - logged.size();
  EXPECT_GE(lacks, 7u);
  EXPECT_EQ(missing("inslab/nav"), std::to_string(lacks));
  EXPECT_THAT(log->output(), HasSubstr("inslab/nav: " + std::to_string(lacks) +
                                       " messages that were sent while this service was away are missing"));
}

}  // namespace killed_logger_test
}  // namespace inslab::e2e
