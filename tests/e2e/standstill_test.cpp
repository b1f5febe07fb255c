// Processes that are stopped for longer than their participants' lease, so that everybody has forgotten them, and
// continued.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "inslab/bus/dds/reader.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/running_set.hpp"

namespace inslab::e2e {
namespace standstill_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

/// What is promised.
constexpr std::chrono::nanoseconds kGoesOnWithin = seconds(2);

class Standstill : public RunningSet {
 protected:
  /// Stops a process until its lease is over for everybody: for `of_it`, a reader of what it writes, and, since not all
  /// see that at the same moment, for two seconds more, which the trajectory server's status tells, ten times a second.
  template <class T>
  void stop(pid_t pid, const dds::Reader<T>& of_it) const {
    ASSERT_NE(pid, 0);
    ASSERT_TRUE(eventually([&] { return of_it.matched_writers() > 0; }, seconds(20)));
    kill(pid, SIGSTOP);
    ASSERT_TRUE(eventually([&] { return of_it.matched_writers() == 0; }, seconds(30))) << "the lease is 10 s";
    const std::uint64_t statuses = client_.statuses();
    ASSERT_TRUE(eventually([&] { return client_.statuses() > statuses + 20; }, seconds(20)));
  }
  /// Continues it; how long it takes until `condition` holds, in seconds.
  template <class Condition>
  double continue_until(pid_t pid, const Condition& condition) {
    const auto begun = Clock::now();
    kill(pid, SIGCONT);
    EXPECT_TRUE(eventually(condition, seconds(30)));
    const std::chrono::duration<double> took = Clock::now() - begun;
    RecordProperty("took_ms", static_cast<int>(took.count() * 1e3));
    return took.count();
  }
  std::uint64_t imu_sequence_of_now() const { return static_cast<std::uint64_t>(sim_time_s() * kImuHz); }
  static constexpr double kPromise_s = std::chrono::duration<double>(kGoesOnWithin).count();
  static constexpr double kImuHz = 200.0;
};

TEST_F(Standstill, AnAppThatIsContinuedAnswersTheNewestSamplesWithinTwoSeconds) {
  std::atomic<std::uint64_t> answered{0};
  const dds::Reader<NavSolution> solutions(
      participant_, dds::topics::nav(),
      [&](const NavSolution& solution, const dds::SampleOrigin&) { answered = solution.imu_sequence; });
  Process run("inslab", {"run", scenario("reference_nav_long"), "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(reaches(4.0)) << run.output();
  const pid_t app = child(run, "inslab-reference-nav");
  stop(app, solutions);
  const std::uint64_t now = imu_sequence_of_now();
  ASSERT_LT(answered + 10 * 200, now);
  EXPECT_LT(continue_until(app, [&] { return answered >= now; }), kPromise_s) << run.output();
  run.send(SIGTERM);
  EXPECT_TRUE(run.wait(seconds(60))) << run.output();
}

TEST_F(Standstill, AServiceThatIsContinuedInRealTimeCatchesUpWithinTwoSecondsAndNoSampleIsLost) {
  std::atomic<std::uint64_t> newest{0};
  const dds::Reader<ImuSample> samples(
      participant_, dds::topics::stream<ImuSample>(0),
      [&](const ImuSample& sample, const dds::SampleOrigin&) { newest = sample.header.sequence_number; });
  Process run("inslab", {"run", scenario("recovery_long"), "--log", log_, "--domain", own_domain(), "--clock",
                         "real_time", "--rate", "1"});
  ASSERT_TRUE(reaches(2.0)) << run.output();
  const pid_t injector = child(run, "inslab-imu-injector");
  stop(injector, samples);
  const std::uint64_t now = imu_sequence_of_now();
  EXPECT_LT(continue_until(injector, [&] { return newest >= now; }), kPromise_s) << run.output();
  run.send(SIGTERM);
  EXPECT_TRUE(run.wait(seconds(60))) << run.output();
  const auto logged = samples_of<ImuSample>(log_, "inslab/imu/0");
  ASSERT_GT(logged.size(), now);
  std::vector<bool> came(logged.size());
  for (const ImuSample& sample : logged) {
    if (sample.header.sequence_number < came.size()) came[sample.header.sequence_number] = true;
  }
  EXPECT_THAT(came, testing::Each(true));
}

TEST_F(Standstill, AServiceThatIsContinuedInLockstepGoesOnWithinTwoSecondsWithTheSameBits) {
  Process offline("inslab", {"simulate", scenario("recovery_long"), "-o", folder_ / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  const std::string reference = folder_ / "offline/recovery_long.mcap";
  const dds::Reader<ImuSample> samples(participant_, dds::topics::stream<ImuSample>(0),
                                       [](const ImuSample&, const dds::SampleOrigin&) {});
  Process run("inslab",
              {"run", scenario("recovery_long"), "--log", log_, "--domain", own_domain(), "--clock", "lockstep"});
  ASSERT_TRUE(reaches(20.0)) << run.output();
  const pid_t injector = child(run, "inslab-imu-injector");
  stop(injector, samples);
  const double stands_at_s = sim_time_s();
  ASSERT_LT(stands_at_s, 299.0);
  EXPECT_LT(continue_until(injector, [&] { return sim_time_s() > stands_at_s + 0.5; }), kPromise_s) << run.output();
  EXPECT_EQ(run.wait(seconds(90)), 0) << run.output();
  expect_same_bits<TruthState>(log_, reference, "inslab/truth", 60001);
  expect_same_bits<ImuSample>(log_, reference, "inslab/imu/0", 60000);
}

}  // namespace standstill_test
}  // namespace inslab::e2e
