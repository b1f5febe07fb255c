// Services that are killed in the middle of a run and started again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/foundation/host/mailbox.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/running_set.hpp"

namespace inslab::e2e {
namespace recovery_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Recovery : public RunningSet {
 protected:
  /// What the scenario gives when nobody is killed.
  std::string offline(const std::string& name) const {
    Process run("inslab", {"simulate", scenario(name), "-o", folder_ / "offline"});
    EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
    return folder_ / ("offline/" + name + ".mcap");
  }
  /// The same, as soon as the set has started it.
  static void kill_child_at_once(const Process& set, const std::string& program) {
    ASSERT_TRUE(eventually([&] { return !children_named(set.pid(), program).empty(); }, seconds(20))) << program;
    kill_child(set, program);
  }
  /// Not so one that has ended and that nobody has asked for its exit code yet.
  static bool is_at_work(pid_t pid) {
    std::string command;
    std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/cmdline"), command, '\0');
    return !command.empty();
  }
  void expect_whole_run(const std::string& reference) const {
    expect_same_bits<TruthState>(log_, reference, "inslab/truth", 2001);
    expect_same_bits<ImuSample>(log_, reference, "inslab/imu/0", 2000);
    expect_same_bits<ImuTruth>(log_, reference, "inslab/imu_truth/0", 2000);
    expect_same_bits<ImuSample>(log_, reference, "inslab/imu/1", 500);
    expect_same_bits<GnssFix>(log_, reference, "inslab/gnss/0", samples_of<GnssFix>(reference, "inslab/gnss/0").size());
    EXPECT_TRUE(mcap::McapReader(log_).closed_properly());
  }
};

TEST_F(Recovery, EachServiceThatIsKilledGoesOnAndNoBitIsLost) {
  const std::string reference = offline("recovery");
  Process run("inslab", {"run", scenario("recovery"), "--log", log_, "--domain", own_domain()});
  // In the middle of a fade; right after a fault; while a swap is on its way.
  ASSERT_TRUE(reaches(2.7)) << run.output();
  kill_child(run, "inslab-imu-injector");
  ASSERT_TRUE(reaches(5.2)) << run.output();
  kill_child(run, "inslab-gnss-emulator");
  ASSERT_TRUE(reaches(6.5)) << run.output();
  // The logger that is to say that this one came back must have seen it.
  ASSERT_TRUE(run.prints("inslab/gnss/0: its service was started again", seconds(30))) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("inslab-imu-injector 0 was ended by signal 9 (Killed) and started again"));
  EXPECT_THAT(run.output(), HasSubstr("recovered: inslab/imu/0: its service was started again"));
  EXPECT_THAT(run.output(), HasSubstr("recovered: inslab/gnss/0: its service was started again"));
  EXPECT_THAT(run.output(), HasSubstr("recovered: the logger was started again and went on with this log"));
  expect_whole_run(reference);
  const mcap::McapReader log(log_);
  for (const mcap::Metadata& record : log.metadata()) {
    if (record.values.count("silence_s") > 0 && record.values.at("what") == "inslab/imu/0") {
      RecordProperty("imu_silence_s", record.values.at("silence_s"));
    }
  }
}

TEST_F(Recovery, AtRatesThatDivideNoneOfTheOthersNoBitIsLostEither) {
  const std::string reference = offline("odd_rates");
  Process run("inslab", {"run", scenario("odd_rates"), "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(reaches(2.7)) << run.output();
  kill_child(run, "inslab-imu-injector");
  ASSERT_TRUE(reaches(5.2)) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("recovered: inslab/imu/0: its service was started again"));
  expect_same_odd_run(log_, reference);
}

TEST_F(Recovery, OfAServiceThatIsKilledAtTheVeryEndNothingIsMissing) {
  const std::string reference = offline("recovery");
  for (const char* victim : {"inslab-imu-injector", "inslab-truth-logger"}) {
    Process run("inslab",
                {"run", scenario("recovery"), "--log", log_, "--domain", own_domain(), "--rate", "2", "--overwrite"});
    ASSERT_TRUE(eventually([&] { return status() && status()->state == RunState::Running; }, seconds(30)));
    ASSERT_TRUE(reaches(9.8)) << run.output();
    kill_child(run, victim);
    EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
    EXPECT_THAT(run.output(), HasSubstr(std::string(victim)));
    EXPECT_THAT(run.output(), HasSubstr("was ended by signal 9 (Killed) and started again, at about "));
    expect_whole_run(reference);
  }
}

/// An injector that is held keeps the run from its end, so that the logger is killed between the others' last word and
/// its own.
TEST_F(Recovery, AServiceThatHasEndedItsStreamStaysForALoggerThatHasNotHeardItsLastWord) {
  const std::string reference = offline("recovery_by_hand");
  host::Mailbox<ServiceStatus> statuses;
  const dds::Reader<ServiceStatus> reader(
      participant_, dds::topics::service_status(),
      [&](const ServiceStatus& status, const dds::SampleOrigin&) { statuses.put(status); });
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_by_hand", {"--log", log_}); };
  auto log = logger();
  const auto imu0 = service("inslab-imu-injector", "recovery_by_hand");
  const auto imu1 = service("inslab-imu-injector", "recovery_by_hand", {"--sensor", "1"});
  const auto gnss = service("inslab-gnss-emulator", "recovery_by_hand");
  const auto truth = service("inslab-trajectory-server", "recovery_by_hand");
  ASSERT_TRUE(reaches(9.5)) << truth->output();
  imu1->send(SIGSTOP);
  const auto says_it_has_ended = [&] {
    const auto status = statuses.take(milliseconds(0));
    return status && status->service == "inslab-imu-injector" && status->sensor_number == 0 &&
           status->state == ServiceState::Finished;
  };
  ASSERT_TRUE(eventually(says_it_has_ended, seconds(30))) << imu0->output();
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  imu1->send(SIGCONT);
  EXPECT_FALSE(imu0->wait(seconds(12)));
  for (const auto* each : {&imu0, &truth}) {
    EXPECT_THAT((*each)->output(), HasSubstr("waits until the logger has closed its log, at most 30 s"));
  }
  log = logger();
  for (const auto* each : {&imu0, &imu1, &gnss, &truth}) EXPECT_EQ((*each)->wait(seconds(40)), 0) << (*each)->output();
  EXPECT_EQ(log->wait(seconds(20)), 0) << log->output();
  expect_whole_run(reference);
}

TEST_F(Recovery, ServicesThatAreKilledBeforeTheRunBeginsAreStartedAgain) {
  const std::string reference = offline("recovery");
  Process run("inslab", {"run", scenario("recovery"), "--log", log_, "--domain", own_domain()});
  kill_child_at_once(run, "inslab-trajectory-server");
  kill_child_at_once(run, "inslab-gnss-emulator");
  EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
  EXPECT_THAT(run.output(),
              HasSubstr("inslab-gnss-emulator 0 was ended by signal 9 (Killed) and started again, before"));
  expect_whole_run(reference);
}

TEST_F(Recovery, ARunWhoseClockIsKilledSaysSoInItsLastLine) {
  Process run("inslab", {"run", scenario("recovery"), "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(reaches(1.0)) << run.output();
  kill_child(run, "inslab-trajectory-server");
  EXPECT_EQ(run.wait(seconds(40)), 1) << run.output();
  EXPECT_THAT(run.output(), ContainsRegex("\nresult: FAILED, exit code 1: inslab-trajectory-server was ended by signal "
                                          "9 .Killed., at about [^\n]*it is the run's clock[^\n]*\n$"));
  EXPECT_TRUE(mcap::McapReader(log_).closed_properly());
}

TEST_F(Recovery, ServicesEndWithTheOneWhoStartedThemHoweverThatOneEnds) {
  Process run("inslab", {"run", scenario("recovery"), "--log", log_, "--domain", own_domain(), "--paused"});
  ASSERT_TRUE(eventually([&] { return status() && status()->state == RunState::Paused; }, seconds(30))) << run.output();
  std::vector<pid_t> services;
  for (const char* name : {"inslab-trajectory-server", "inslab-imu-injector", "inslab-truth-logger"}) {
    for (const pid_t pid : children_named(run.pid(), name)) services.push_back(pid);
  }
  ASSERT_EQ(services.size(), 4U);
  run.send(SIGKILL);
  for (const pid_t pid : services) {
    EXPECT_TRUE(eventually([pid] { return !is_at_work(pid); }, seconds(20))) << pid;
  }
  EXPECT_TRUE(mcap::McapReader(log_).closed_properly());
}

TEST_F(Recovery, InLockstepAKilledConsumerStopsTheClockUntilItIsBack) {
  const std::string reference = offline("recovery_long");
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_long", {"--log", log_}); };
  auto log = logger();
  auto imu = service("inslab-imu-injector", "recovery_long");
  auto gnss = service("inslab-gnss-emulator", "recovery_long");
  const auto truth = service("inslab-trajectory-server", "recovery_long");
  ASSERT_TRUE(reaches(20.0)) << truth->output();
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  // The window of a stream runs full; from then on the same status comes again and again.
  std::int64_t stands_at_ns = -1;
  EXPECT_TRUE(eventually(
      [&] {
        const auto statuses = client_.statuses();
        const std::int64_t before_ns = status()->sim_time_ns;
        EXPECT_TRUE(eventually([&] { return client_.statuses() > statuses + 5; }, seconds(20)));
        stands_at_ns = status()->sim_time_ns;
        return stands_at_ns == before_ns;
      },
      seconds(30)));
  EXPECT_LT(stands_at_ns, 300'000'000'000);
  log = logger();
  ASSERT_TRUE(reaches(time::to_seconds(stands_at_ns) + 10.0)) << log->output() << truth->output();
  imu->send(SIGKILL);
  ASSERT_EQ(imu->wait(seconds(10)), 128 + SIGKILL);
  imu = service("inslab-imu-injector", "recovery_long");
  EXPECT_EQ(truth->wait(seconds(60)), 0) << truth->output();
  EXPECT_EQ(imu->wait(seconds(20)), 0) << imu->output();
  EXPECT_EQ(gnss->wait(seconds(20)), 0) << gnss->output();
  EXPECT_EQ(log->wait(seconds(20)), 0) << log->output();
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "state"));
  expect_same_bits<TruthState>(log_, reference, "inslab/truth", 60001);
  expect_same_bits<ImuSample>(log_, reference, "inslab/imu/0", 60000);
  expect_same_bits<ImuTruth>(log_, reference, "inslab/imu_truth/0", 60000);
  expect_same_bits<GnssFix>(log_, reference, "inslab/gnss/0", samples_of<GnssFix>(reference, "inslab/gnss/0").size());
}

TEST_F(Recovery, ARunWhoseTrajectoryServerWasKilledIsEndedByTheNextOneAndNotRunAgain) {
  const auto log = service("inslab-truth-logger", "recovery", {"--log", log_});
  const auto imu0 = service("inslab-imu-injector", "recovery");
  const auto imu1 = service("inslab-imu-injector", "recovery", {"--sensor", "1"});
  const auto gnss = service("inslab-gnss-emulator", "recovery");
  auto truth = service("inslab-trajectory-server", "recovery");
  ASSERT_TRUE(reaches(1.0)) << truth->output();
  truth->send(SIGKILL);
  ASSERT_EQ(truth->wait(seconds(10)), 128 + SIGKILL);
  truth = service("inslab-trajectory-server", "recovery");
  EXPECT_EQ(truth->wait(seconds(40)), 1) << truth->output();
  EXPECT_THAT(truth->output(), HasSubstr("it ends as a fault"));
  for (const auto* process : {&imu0, &imu1, &gnss}) {
    EXPECT_EQ((*process)->wait(seconds(30)), 1) << (*process)->output();
    EXPECT_THAT((*process)->output(), HasSubstr("the run ended as a fault"));
  }
  EXPECT_TRUE(log->wait(seconds(30))) << log->output();
  const mcap::McapReader reader(log_);
  EXPECT_TRUE(reader.closed_properly());
  const auto logged = samples_of<TruthState>(log_, "inslab/truth");
  ASSERT_GT(logged.size(), 200u);
  for (std::size_t i = 0; i < logged.size(); ++i) {
    ASSERT_EQ(logged[i].header.sequence_number, i);
    ASSERT_EQ(logged[i].header.run_id, logged[0].header.run_id);
  }
}

TEST_F(Recovery, AServiceThatComesTooLateAndKnowsNothingSaysSo) {
  const auto log = service("inslab-truth-logger", "recovery_long", {"--log", log_});
  const auto imu = service("inslab-imu-injector", "recovery_long");
  auto gnss = service("inslab-gnss-emulator", "recovery_long");
  const auto truth = service("inslab-trajectory-server", "recovery_long", {"--clock", "real_time", "--rate", "20"});
  ASSERT_TRUE(reaches(1.0)) << truth->output();
  gnss->send(SIGKILL);
  ASSERT_EQ(gnss->wait(seconds(10)), 128 + SIGKILL);
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "state")) {
    if (entry.path().filename().string().rfind("inslab-gnss", 0) == 0) std::filesystem::remove(entry.path());
  }
  ASSERT_TRUE(reaches(45.0)) << truth->output();  // the truth keeps half a minute
  gnss = service("inslab-gnss-emulator", "recovery_long");
  EXPECT_EQ(gnss->wait(seconds(60)), 1) << gnss->output();
  EXPECT_THAT(gnss->output(), HasSubstr("cannot be had: there is no checkpoint of this run to go on from"));
  EXPECT_EQ(truth->wait(seconds(60)), 1) << truth->output();
  EXPECT_EQ(status()->state, RunState::Fault);
  EXPECT_THAT(status()->message, ContainsRegex("^inslab-gnss-emulator 0: truth samples 0 to [0-9]* cannot be had"));
}

/// It is lost after that, since it aligns only at rest. But it answers again, and nothing of the rest is missing.
TEST_F(Recovery, AKilledReferenceNavigationAppAnswersAgainInLockstepToo) {
  Process run("inslab",
              {"run", scenario("reference_nav_long"), "--domain", own_domain(), "--log", log_, "--clock", "lockstep"});
  ASSERT_TRUE(reaches(30.0)) << run.output();
  kill_child(run, "inslab-reference-nav");
  constexpr int kNotAccepted = 4;
  EXPECT_EQ(run.wait(seconds(120)), kNotAccepted) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("inslab-reference-nav was ended by signal 9 (Killed) and started again"));
  EXPECT_THAT(run.output(), Not(HasSubstr("FAILED:")));
  const auto solutions = samples_of_kind<NavSolution>(log_, "inslab/nav");
  ASSERT_FALSE(solutions.empty());
  EXPECT_EQ(solutions.back().imu_sequence, 59'999u);
  EXPECT_EQ(solutions.back().mode, NavMode::Aligning);
}

}  // namespace recovery_test
}  // namespace inslab::e2e
