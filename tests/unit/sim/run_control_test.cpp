#include <gtest/gtest.h>

#include <cmath>

#include "inslab/sim/run_gate.hpp"

namespace inslab::sim {
namespace run_control_test {

SimCommand command(CommandKind kind, double value = 0.0) { return {7, kind, value}; }

TEST(RunControl, PausesAndResumes) {
  RunControl control(ClockMode::RealTime, false);
  EXPECT_TRUE(control.judge(command(CommandKind::Pause), 10).pace_changed);
  EXPECT_TRUE(control.paused());
  EXPECT_FALSE(control.judge(command(CommandKind::Pause), 10).pace_changed);
  EXPECT_TRUE(control.judge(command(CommandKind::Resume), 10).pace_changed);
  EXPECT_FALSE(control.paused());
}

TEST(RunControl, AStepSendsThatManySamplesAndPausesAgain) {
  RunControl control(ClockMode::Lockstep, true);
  EXPECT_TRUE(control.judge(command(CommandKind::Step, 3.0), 10).pace_changed);
  EXPECT_FALSE(control.paused());
  EXPECT_FALSE(control.note_sent(11));
  EXPECT_FALSE(control.note_sent(12));
  EXPECT_TRUE(control.note_sent(13));
  EXPECT_TRUE(control.paused());
}

TEST(RunControl, PauseAndResumeEndSteps) {
  RunControl control(ClockMode::RealTime, true);
  control.judge(command(CommandKind::Step, 100.0), 0);
  control.judge(command(CommandKind::Pause), 5);
  EXPECT_TRUE(control.paused());
  control.judge(command(CommandKind::Step, 100.0), 5);
  control.judge(command(CommandKind::Resume), 6);
  EXPECT_FALSE(control.note_sent(105));
  EXPECT_FALSE(control.paused());
}

TEST(RunControl, RefusesStepsOfARunThatIsNotPaused) {
  RunControl control(ClockMode::RealTime, false);
  EXPECT_EQ(control.judge(command(CommandKind::Step, 1.0), 0).refusal, "a step needs a paused run");
  control.judge(command(CommandKind::Pause), 0);
  control.judge(command(CommandKind::Step, 5.0), 0);
  EXPECT_EQ(control.judge(command(CommandKind::Step, 5.0), 1).refusal, "steps are still going on");
}

class BadSteps : public testing::TestWithParam<double> {};

TEST_P(BadSteps, AreRefusedAndChangeNothing) {
  RunControl control(ClockMode::RealTime, true);
  EXPECT_FALSE(control.judge(command(CommandKind::Step, GetParam()), 0).refusal.empty());
  EXPECT_TRUE(control.paused());
}

INSTANTIATE_TEST_SUITE_P(Values, BadSteps, testing::Values(0.0, -1.0, 1.5, 1e300, std::nan(""), INFINITY));

TEST(RunControl, TakesARateWithinItsLimitsOnly) {
  RunControl control(ClockMode::RealTime, false);
  EXPECT_EQ(control.judge(command(CommandKind::Rate, 5.0), 0).rate, 5.0);
  for (const double bad : {0.0, -1.0, 0.009, 1000.1, std::nan(""), double(INFINITY)}) {
    const auto verdict = control.judge(command(CommandKind::Rate, bad), 0);
    EXPECT_EQ(verdict.rate, std::nullopt) << bad;
    EXPECT_FALSE(verdict.refusal.empty()) << bad;
  }
}

TEST(RunControl, LockstepHasNoRate) {
  RunControl control(ClockMode::Lockstep, false);
  EXPECT_FALSE(control.judge(command(CommandKind::Rate, 5.0), 0).refusal.empty());
}

TEST(RunControl, StopIsObeyedInEveryState) {
  RunControl control(ClockMode::Lockstep, true);
  control.judge(command(CommandKind::Stop), 0);
  EXPECT_TRUE(control.stop_requested());
}

}  // namespace run_control_test
}  // namespace inslab::sim
