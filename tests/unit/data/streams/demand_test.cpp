#include "inslab/data/streams/demand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace inslab::streams {
namespace demand_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

/// The logger's demand of one stream, looked at every 10 ms.
class Logger {
 public:
  explicit Logger(ClockMode clock) : clock_(clock) { demand_.begin(demand_of_log(clock, false), now_); }

  void run_ends() { demand_.change(demand_of_log(clock_, true), now_); }
  void comes(std::uint64_t number) {
    demand_.came(now_);
    if (number == known_.next) known_.next = number + 1;
    known_.newer_came = number >= known_.next;
  }
  void hears_of(std::uint64_t sent) {
    known_.more_was_sent = known_.next < sent;
    known_.more_may_have_been_sent = false;
  }
  /// When it spoke within that time, in milliseconds from now on; `resend`: for something once more.
  std::vector<std::int64_t> speaks_within(time::Nanoseconds duration, bool resend) {
    std::vector<std::int64_t> at_ms;
    for (const time::Nanoseconds begun = now_; now_ < begun + duration;) {
      now_ += milliseconds(10);
      const auto ask = demand_.look(known_, now_);
      if (ask && ask->resend == resend) at_ms.push_back((now_ - begun) / milliseconds(1));
    }
    return at_ms;
  }
  std::vector<std::int64_t> asks_within(time::Nanoseconds duration) { return speaks_within(duration, true); }
  bool has_given_up() const { return demand_.gave_up(known_.next, now_); }

 private:
  ClockMode clock_;
  time::Nanoseconds now_{seconds(50)};
  Demand demand_;
  Known known_;
};

TEST(DemandOfTheLog, BeginsWithWhatWasSentBefore) {
  Logger logger(ClockMode::RealTime);
  EXPECT_THAT(logger.asks_within(seconds(100)), ElementsAre(10));
}

TEST(DemandOfTheLog, GivesNothingUp) {
  Logger logger(ClockMode::RealTime);
  logger.comes(0);
  logger.comes(2);
  EXPECT_FALSE(logger.asks_within(seconds(3600)).empty());
  EXPECT_FALSE(logger.has_given_up());
}

TEST(DemandOfTheLog, AtTheEndOfARunTakesSilenceForASignInRealTimeToo) {
  Logger logger(ClockMode::RealTime);
  logger.comes(0);
  logger.asks_within(seconds(5));
  EXPECT_THAT(logger.asks_within(seconds(30)), IsEmpty());
  logger.run_ends();
  const auto asked = logger.asks_within(seconds(30));
  EXPECT_FALSE(asked.empty());
  EXPECT_LT(asked.size(), 30u) << "600 without a back-off";
}

TEST(DemandOfTheLog, AtTheEndOfARunSaysAtOnceThatEverythingIsThereAndThenLessAndLessOften) {
  Logger logger(ClockMode::RealTime);
  logger.comes(0);
  logger.asks_within(seconds(5));
  logger.run_ends();
  logger.hears_of(1);
  EXPECT_THAT(logger.speaks_within(seconds(4), false), ElementsAre(10, 60, 160, 360, 760, 1560, 3160));
}

TEST(DemandOfTheLog, AsksForATailOfWhichItHasHeard) {
  Logger logger(ClockMode::RealTime);
  logger.comes(0);
  logger.asks_within(seconds(5));
  logger.run_ends();
  logger.hears_of(2);
  EXPECT_THAT(logger.asks_within(milliseconds(100)), ElementsAre(10, 60));
  logger.comes(1);
  logger.hears_of(2);
  EXPECT_THAT(logger.asks_within(seconds(10)), IsEmpty());
}

TEST(Demand, ANewGapIsWaitedForAsLongAsTheOneBefore) {
  Demand demand;
  demand.begin(demand_of_truth(ClockMode::RealTime), seconds(0));
  Known known;
  known.newer_came = true;
  known.next = 4;
  for (time::Nanoseconds now = seconds(0); now <= seconds(8); now += milliseconds(50)) demand.look(known, now);
  EXPECT_FALSE(demand.gave_up(4, seconds(8)));
  EXPECT_TRUE(demand.gave_up(4, seconds(8) + milliseconds(1)));
  EXPECT_FALSE(demand.gave_up(7, seconds(9))) << "another one, at which nobody has looked";
  known.newer_came = false;
  demand.look(known, seconds(9));
  EXPECT_FALSE(demand.gave_up(4, seconds(9))) << "it has come";
}

TEST(Demand, InRealTimeAnAppAsksWithinItsPatience) {
  const DemandPolicy policy = demand_of_input(ClockMode::RealTime);
  EXPECT_LT(4 * policy.repeat, policy.patience);
  EXPECT_EQ(policy.silence, kNever);
  EXPECT_FALSE(policy.keeps_saying);
}

TEST(Demand, WhatIsAskedForTwiceWithinPatienceIsAskedForMoreThanOnceAtItsLongestInterval) {
  for (const ClockMode clock : {ClockMode::RealTime, ClockMode::Lockstep}) {
    const DemandPolicy policy = demand_of_truth(clock);
    EXPECT_LT(4 * policy.longest_repeat, policy.patience);
    EXPECT_LE(policy.longest_repeat, seconds(2)) << "a service that was stopped goes on within two seconds";
  }
}

}  // namespace demand_test
}  // namespace inslab::streams
