#include "inslab/data/streams/run_follower.hpp"

#include <gtest/gtest.h>

namespace inslab::streams {
namespace run_follower_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Heard = RunFollower::Heard;
using Phase = RunFollower::Phase;

const RunId kRun{{1}};
const RunId kAnotherRun{{2}};
constexpr time::Nanoseconds kNow = seconds(100);

SimStatus status(RunState state, const RunId& run = kRun, std::uint64_t truth_samples = 0) {
  SimStatus status;
  status.run_id = run;
  status.state = state;
  status.truth_samples = truth_samples;
  status.clock = ClockMode::Lockstep;
  return status;
}

RunFollower following(RunState state) {
  RunFollower follower;
  follower.hear(status(state), kNow);
  return follower;
}

TEST(RunFollower, FollowsARunFromItsFirstWordToItsEnd) {
  RunFollower follower;
  EXPECT_EQ(follower.run(), RunId{});
  EXPECT_EQ(follower.hear(status(RunState::Waiting), kNow), Heard::TheRun);
  EXPECT_EQ(follower.phase(), Phase::Waiting);
  EXPECT_TRUE(follower.is_lockstep());
  EXPECT_EQ(follower.hear(status(RunState::Waiting), kNow), Heard::OfTheRun);
  EXPECT_EQ(follower.hear(status(RunState::Running), kNow), Heard::OfTheRun);
  EXPECT_EQ(follower.phase(), Phase::Begun);
  EXPECT_EQ(follower.hear(status(RunState::Paused), kNow), Heard::OfTheRun);
  EXPECT_EQ(follower.hear(status(RunState::Finished, kRun, 2001), kNow), Heard::ItsEnd);
  EXPECT_EQ(follower.phase(), Phase::Ended);
  EXPECT_EQ(follower.truth_samples(), 2001u);
  EXPECT_EQ(follower.fault(), "");
}

TEST(RunFollower, ARunThatHasBegunIsNotLeftForAnother) {
  RunFollower follower = following(RunState::Running);
  EXPECT_EQ(follower.hear(status(RunState::Running, kAnotherRun), kNow), Heard::OfAnother);
  EXPECT_EQ(follower.hear(status(RunState::Finished, kAnotherRun, 7), kNow), Heard::OfAnother);
  EXPECT_EQ(follower.run(), kRun);
  EXPECT_FALSE(follower.has_ended());
  follower.hear(status(RunState::Finished), kNow);
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::OfAnother) << "its service ends";
}

TEST(RunFollower, ARunThatHasNotBegunGivesWayToTheNextOfItsServer) {
  RunFollower follower = following(RunState::Waiting);
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::TheRun);
  EXPECT_EQ(follower.run(), kAnotherRun);
}

TEST(RunFollower, ASampleShowsThatARunHasBegunWhoseStatusSaysThatItWaits) {
  RunFollower follower = following(RunState::Waiting);
  follower.note_sample(kNow);
  EXPECT_TRUE(follower.has_begun());
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::OfAnother);
}

TEST(RunFollower, OneThatWasStartedForARunFollowsNoOther) {
  RunFollower follower(kAnotherRun);
  EXPECT_FALSE(follower.takes(kRun));
  EXPECT_TRUE(follower.takes(kAnotherRun));
  EXPECT_EQ(follower.hear(status(RunState::Waiting), kNow), Heard::OfAnother);
  EXPECT_EQ(follower.run(), RunId{});
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::TheRun);
}

TEST(RunFollower, BeforeARunIsKnownSamplesOfAnyCountAndThenOfThatOneAlone) {
  RunFollower follower;
  EXPECT_TRUE(follower.takes(kRun));
  EXPECT_TRUE(follower.takes(kAnotherRun));
  follower.hear(status(RunState::Waiting), kNow);
  EXPECT_TRUE(follower.takes(kRun));
  EXPECT_FALSE(follower.takes(kAnotherRun));
}

TEST(RunFollower, ACommandStaysWithTheFirstRunAndGoesOnToTheNextWhenThatHasEnded) {
  RunFollower follower(RunId{}, RunFollower::Changes::WhenItEnded);
  follower.hear(status(RunState::Waiting), kNow);
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::OfAnother);
  follower.hear(status(RunState::Fault), kNow);
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::TheRun);
  EXPECT_EQ(follower.phase(), Phase::Waiting);
  EXPECT_EQ(follower.fault(), "");
}

TEST(RunFollower, ACommandOfOneRunDoesNotGoOnToTheNext) {
  RunFollower follower(kRun, RunFollower::Changes::WhenItEnded);
  follower.hear(status(RunState::Finished), kNow);
  EXPECT_EQ(follower.hear(status(RunState::Waiting, kAnotherRun), kNow), Heard::OfAnother);
}

TEST(RunFollower, OneThatComesLateHearsOfTheEndAtOnce) {
  RunFollower follower;
  EXPECT_EQ(follower.hear(status(RunState::Stopped, kRun, 40), kNow), Heard::TheRun);
  EXPECT_TRUE(follower.has_ended());
  EXPECT_EQ(follower.truth_samples(), 40u);
}

TEST(RunFollower, SaysWhyARunEndedAsAFault) {
  RunFollower follower = following(RunState::Running);
  SimStatus fault = status(RunState::Fault);
  fault.message = "the machine is too busy";
  EXPECT_EQ(follower.hear(fault, kNow), Heard::ItsEnd);
  EXPECT_EQ(follower.fault(), "the machine is too busy");
}

TEST(RunFollower, PatienceAtTheEndCountsFromItsFirstWord) {
  RunFollower follower = following(RunState::Running);
  EXPECT_FALSE(follower.ended_before(seconds(8), kNow + seconds(3600)));
  follower.hear(status(RunState::Finished), kNow);
  follower.hear(status(RunState::Finished), kNow + seconds(7));  // said again to one that joined late
  EXPECT_FALSE(follower.ended_before(seconds(8), kNow + seconds(8)));
  EXPECT_TRUE(follower.ended_before(seconds(8), kNow + seconds(8) + milliseconds(1)));
}

TEST(RunFollower, StaysForALoggerUntilThatHasClosedTheLogOfThisRun) {
  RunFollower follower = following(RunState::Running);
  EXPECT_FALSE(follower.stays_for_the_log(kNow)) << "the run goes on";
  follower.hear(status(RunState::Finished), kNow);
  EXPECT_TRUE(follower.stays_for_the_log(kNow));
  EXPECT_TRUE(follower.take(log_word(kAnotherRun, true)));
  EXPECT_TRUE(follower.stays_for_the_log(kNow));
  EXPECT_TRUE(follower.take(log_word(kRun, false)));
  EXPECT_TRUE(follower.stays_for_the_log(kNow));
  EXPECT_TRUE(follower.take(log_word(kRun, true)));
  EXPECT_FALSE(follower.stays_for_the_log(kNow));
}

TEST(RunFollower, ALoggerThatDoesNotComeBackIsNotWaitedForForEver) {
  RunFollower follower = following(RunState::Finished);
  EXPECT_TRUE(follower.stays_for_the_log(kNow + kTimeToComeBack));
  EXPECT_FALSE(follower.stays_for_the_log(kNow + kTimeToComeBack + milliseconds(1)));
}

TEST(RunFollower, TellsOnceThatItWaits) {
  RunFollower follower = following(RunState::Finished);
  EXPECT_FALSE(follower.tells_the_wait(kNow + seconds(2)));
  EXPECT_TRUE(follower.tells_the_wait(kNow + seconds(3)));
  EXPECT_FALSE(follower.tells_the_wait(kNow + seconds(4)));
}

TEST(RunFollower, TakesNoOtherCredit) {
  RunFollower follower;
  Credit credit = log_word(kRun, true);
  credit.topic = "inslab/truth";
  EXPECT_FALSE(follower.take(credit));
  credit = log_word(kRun, true);
  credit.consumer = "inslab-imu-injector";
  EXPECT_FALSE(follower.take(credit));
}

TEST(RunFollower, GoesOnForAnotherProcessOfItsService) {
  RunFollower follower;
  follower.go_on(kRun, ClockMode::Lockstep, Phase::Begun, kNow);
  EXPECT_EQ(follower.hear(status(RunState::Running), kNow), Heard::OfTheRun);
  EXPECT_EQ(follower.hear(status(RunState::Running, kAnotherRun), kNow), Heard::OfAnother);
  RunFollower late;
  late.go_on(kRun, ClockMode::RealTime, Phase::Ended, kNow);
  EXPECT_TRUE(late.stays_for_the_log(kNow));
}

}  // namespace run_follower_test
}  // namespace inslab::streams
