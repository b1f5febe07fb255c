#include "inslab/data/streams/identity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inslab/foundation/host/host.hpp"

namespace inslab::streams {
namespace identity_test {

using testing::HasSubstr;

Identity injector() {
  Identity identity;
  identity.service = "inslab-imu-injector";
  identity.sensor_number = 3;
  identity.unit = "car";
  identity.host = "bench";
  identity.process_space = "here";
  identity.pid = 4711;
  identity.started_ticks = 99;
  identity.since_realtime_ns = 1'800'000'000'000'000'000;
  identity.version = "1.2.3";
  identity.scenario = "demo";
  identity.scenario_hash = std::string(64, 'a');
  return identity;
}

TEST(Identity, ComesOutOfItsAnnouncement) {
  const auto heard = identity_in(announced(injector()));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->role(), injector().role());
  EXPECT_EQ(heard->unit, "car");
  EXPECT_EQ(heard->pid, 4711u);
  EXPECT_EQ(heard->scenario_hash, injector().scenario_hash);
  EXPECT_EQ(difference(*heard, injector()), "");
}

TEST(Identity, IsInNothingElse) {
  EXPECT_FALSE(identity_in({}));
  EXPECT_FALSE(identity_in({'e', 'n', 'c', 'l', 'a', 'v', 'e', '=', '/', ';'}));
  const std::vector<std::uint8_t> whole = announced(injector());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(identity_in({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
  }
}

TEST(Identity, SaysWhoItIs) {
  EXPECT_EQ(words_of(injector()),
            "inslab-imu-injector 3 (host bench, process 4711, since 2027-01-15 08:00:00 UTC, scenario 'demo')");
}

TEST(Identity, OfAnotherScenarioVersionOrRunDiffers) {
  Identity other = injector();
  other.scenario_hash = std::string(64, 'b');
  EXPECT_THAT(difference(injector(), other), HasSubstr("both scenarios are called 'demo'"));
  other.scenario = "elsewhere";
  EXPECT_EQ(difference(injector(), other), "one has the scenario 'demo', the other 'elsewhere'");
  other = injector();
  other.version = "1.2.4";
  EXPECT_EQ(difference(injector(), other), "one is inslab 1.2.3, the other 1.2.4");
  other = injector();
  other.run_id.bytes.fill(1);
  EXPECT_EQ(difference(injector(), other), "") << "one obeys any run";
  Identity third = other;
  third.run_id.bytes.fill(2);
  EXPECT_EQ(difference(other, third), "they were started for different runs");
}

TEST(Identity, YieldsToWhoeverWasThereAndOfTwoThatBeginTogetherTheSecondYields) {
  Identity second = injector();
  second.since_realtime_ns += 300'000'000;
  EXPECT_TRUE(must_yield(second, injector()));
  EXPECT_FALSE(must_yield(injector(), second));
  Identity of_a_wrong_clock = injector();
  of_a_wrong_clock.since_realtime_ns += 3'600'000'000'000;
  EXPECT_TRUE(must_yield(injector(), of_a_wrong_clock));
  Identity same_instant = injector();
  same_instant.pid = 4712;
  EXPECT_NE(must_yield(injector(), same_instant), must_yield(same_instant, injector()));
}

TEST(Host, KnowsWhenAProcessStartedAndThatOneHasEnded) {
  const auto own = host::started_ticks(host::process_id());
  ASSERT_TRUE(own);
  EXPECT_EQ(host::started_ticks(host::process_id()), own);
  const pid_t child = fork();
  if (child == 0) _exit(0);
  // Ended and not waited for it is a zombie, which is no process any more.
  siginfo_t ended;
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_FALSE(host::started_ticks(static_cast<std::uint32_t>(child)));
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED), 0);
  EXPECT_FALSE(host::started_ticks(static_cast<std::uint32_t>(child)));
}

TEST(RunIdText, ReadsBack) {
  const RunId run = host::random_run_id();
  EXPECT_EQ(host::run_id_of(host::run_id_text(run)), run);
  EXPECT_FALSE(host::run_id_of(""));
  EXPECT_FALSE(host::run_id_of(std::string(31, '0')));
  EXPECT_FALSE(host::run_id_of(std::string(31, '0') + "g"));
}

}  // namespace identity_test
}  // namespace inslab::streams
