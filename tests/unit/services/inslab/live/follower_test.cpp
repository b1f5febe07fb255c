#include "inslab/services/inslab/live/follower.hpp"

#include <gmock/gmock.h>

#include "tests/unit/bus/client/fake_link.hpp"

namespace inslab::live {
namespace follower_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FollowedRun : public testing::Test {
 protected:
  Follower follower(Follower::Options options) {
    options.where = "domain 7";
    return {link_,
            std::move(options),
            {[this](const std::string& event) { events_.push_back(event); },
             [this](const std::string& word) { words_.push_back(word); }, [](time::Nanoseconds) {}},
            time::Nanoseconds(0)};
  }
  test::FakeLink link_;
  std::vector<std::string> events_;
  std::vector<std::string> words_;
};

TEST_F(FollowedRun, IsToldFromItsBeginningToItsEnd) {
  Follower run = follower({});
  link_.hear(RunState::Waiting, 0.0);
  EXPECT_FALSE(run.step(seconds(1)));
  link_.hear(RunState::Running, 0.1);
  EXPECT_FALSE(run.step(seconds(2)));
  link_.hear(RunState::Finished, 10.0);
  const auto ending = run.step(seconds(3));
  ASSERT_TRUE(ending);
  EXPECT_TRUE(ending->good);
  EXPECT_THAT(events_, ElementsAre("run 01010101010101010101010101010101", "begins", "ends"));
}

TEST_F(FollowedRun, GetsItsSwapsOnceTheServerListens) {
  link_.is_connected = false;
  Follower run = follower({60.0, false, "", {test::imu_swap(1), test::imu_swap(2)}});
  link_.hear(RunState::Waiting, 0.0);
  run.step(seconds(1));
  EXPECT_THAT(link_.requests, IsEmpty());
  link_.is_connected = true;
  run.step(seconds(2));
  run.step(seconds(3));
  EXPECT_EQ(link_.requests.size(), 2u);
}

TEST_F(FollowedRun, IsReleasedWhenEachSwapIsInTheJournalOrRefusedAndAgainWhenThatIsNotHeard) {
  Follower run = follower({60.0, true, "", {test::imu_swap(1), test::imu_swap(2)}});
  link_.hear(RunState::Paused, 0.0, 1);
  run.step(seconds(1));
  EXPECT_THAT(link_.commands, IsEmpty());
  link_.answer(2, AckOutcome::Rejected);
  run.step(seconds(2));
  run.step(seconds(2) + milliseconds(500));
  ASSERT_EQ(link_.commands.size(), 1u);
  EXPECT_EQ(link_.commands[0].kind, CommandKind::Resume);
  run.step(seconds(3));
  EXPECT_EQ(link_.commands.size(), 2u) << "a command may be lost";
  link_.hear(RunState::Running, 0.1, 1);
  run.step(seconds(5));
  EXPECT_EQ(link_.commands.size(), 2u);
}

TEST_F(FollowedRun, IsGivenUpAfterSilence) {
  Follower run = follower({5.0, false, "", {}});
  EXPECT_FALSE(run.step(seconds(3)));
  EXPECT_THAT(words_, ElementsAre("waits for a trajectory server in domain 7"));
  EXPECT_EQ(run.step(seconds(5))->why, "no trajectory server was found within 5 s");
  link_.hear(RunState::Running, 1.0);
  EXPECT_FALSE(run.step(seconds(6)));
  EXPECT_FALSE(run.step(seconds(10)));
  EXPECT_EQ(run.step(seconds(11))->why, "no word of the trajectory server within 5 s");
}

TEST_F(FollowedRun, EndsBadlyWithAFaultAndWhenAnotherRunIsInItsPlace) {
  Follower run = follower({});
  link_.hear(RunState::Fault, 1.0);
  link_.last_status->message = "a sensor died";
  EXPECT_EQ(run.step(seconds(1))->why, "the run did not finish: fault: a sensor died");
  link_.other = "another run is in its place";
  EXPECT_THAT(run.step(seconds(2))->why, HasSubstr("another run"));
}

TEST_F(FollowedRun, EndsBadlyWithSwapsThatWereNotSent) {
  link_.is_connected = false;
  Follower run = follower({60.0, false, "", {test::imu_swap(1)}});
  link_.hear(RunState::Finished, 1.0);
  EXPECT_EQ(run.step(seconds(1))->why, "the run ended before all swaps were sent");
}

}  // namespace follower_test
}  // namespace inslab::live
