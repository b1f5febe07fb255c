#include "inslab/data/streams/receiver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab::streams {
namespace receiver_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::Optional;
using testing::Pair;
using Numbers = std::vector<std::uint64_t>;

const RunId kRun{{1}};
const RunId kAnotherRun{{2}};

/// A consumer of one stream under a clock that the test sets. It looks every 50 ms, as the services do.
class Consumer {
 public:
  explicit Consumer(const DemandPolicy& policy) { receiver_.begin_run(kRun, policy, now_); }

  void come(const Numbers& numbers, const RunId& run = kRun) {
    Arrived<GnssFix> arrived;
    for (const std::uint64_t number : numbers) {
      GnssFix fix;
      fix.header.run_id = run;
      fix.header.sequence_number = number;
      arrived.samples.push_back(fix);
    }
    receiver_.add(arrived, now_);
  }
  /// The numbers of what can be had in order now.
  Numbers take() {
    Numbers taken;
    while (const auto fix = receiver_.take(now_)) taken.push_back(fix->header.sequence_number);
    return taken;
  }
  /// Whether it asks for something again when it looks now.
  bool asks() {
    const auto ask = receiver_.look(consumer_, now_);
    return ask && ask->resend;
  }
  /// Lets time pass; when it spoke, in milliseconds from now on, and meant that something be sent again.
  std::vector<std::int64_t> asks_within(time::Nanoseconds duration) { return speaks(duration, true); }
  /// The same of what it says while it lacks nothing.
  std::vector<std::int64_t> says_within(time::Nanoseconds duration) { return speaks(duration, false); }
  /// Time in which the process does nothing, as one that is stopped.
  void stand_still(time::Nanoseconds duration) { now_ += duration; }

  Receiver<GnssFix>& receiver() { return receiver_; }
  Receiver<GnssFix>::Consumer& consumer() { return consumer_; }
  auto lost() const { return receiver_.lost(now_); }
  StreamStatus counts() const { return receiver_.monitor().status(); }
  time::Nanoseconds now() const { return now_; }

 private:
  std::vector<std::int64_t> speaks(time::Nanoseconds duration, bool resend) {
    std::vector<std::int64_t> at_ms;
    const time::Nanoseconds begun = now_;
    while (now_ < begun + duration) {
      now_ += milliseconds(50);
      const auto ask = receiver_.look(consumer_, now_);
      if (ask && ask->resend == resend) at_ms.push_back((now_ - begun) / milliseconds(1));
    }
    return at_ms;
  }

  time::Nanoseconds now_{seconds(1000)};
  Receiver<GnssFix> receiver_{"inslab/gnss/0"};
  Receiver<GnssFix>::Consumer consumer_;
};

Consumer of_truth(ClockMode clock) { return Consumer(demand_of_truth(clock)); }
Consumer of_input(ClockMode clock) { return Consumer(demand_of_input(clock)); }

Numbers from_to(std::uint64_t first, std::uint64_t last) {
  Numbers numbers(last + 1 - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

TEST(Receiver, HandsOnAWholeStreamAndAsksForNothing) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  EXPECT_TRUE(consumer.asks()) << "for what was sent before it came";
  consumer.come({0, 1});
  consumer.come({2});
  EXPECT_THAT(consumer.take(), ElementsAre(0, 1, 2));
  EXPECT_THAT(consumer.asks_within(seconds(100)), IsEmpty());
}

TEST(Receiver, ASampleThatIsLostIsAskedForUntilItComesAndNothingOvertakesIt) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.asks();
  consumer.come({0, 1, 3, 4});
  EXPECT_THAT(consumer.take(), ElementsAre(0, 1));
  EXPECT_FALSE(consumer.asks_within(seconds(3)).empty());
  EXPECT_THAT(consumer.take(), IsEmpty());
  consumer.come({2});
  EXPECT_THAT(consumer.take(), ElementsAre(2, 3, 4));
  EXPECT_THAT(consumer.asks_within(seconds(3)), IsEmpty());
  EXPECT_EQ(consumer.counts().lost, 0u);
}

TEST(Receiver, WhenPartOfWhatWasAskedForComesTheRestIsAskedForAtOnce) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.asks();
  consumer.come({0, 300});
  consumer.take();
  consumer.asks_within(milliseconds(500));
  consumer.come(from_to(1, 128));
  consumer.take();
  EXPECT_TRUE(consumer.asks());
  EXPECT_FALSE(consumer.asks()) << "once";
}

TEST(Receiver, WhatComesTwiceIsHandedOnOnceAndCounted) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 1, 1});
  consumer.come({0, 2});
  EXPECT_THAT(consumer.take(), ElementsAre(0, 1, 2));
  consumer.come({0, 1, 2});
  EXPECT_THAT(consumer.take(), IsEmpty());
  EXPECT_EQ(consumer.counts().duplicates, 5u);
  EXPECT_EQ(consumer.counts().lost, 0u);
}

TEST(Receiver, InWhateverOrderSamplesComeTheyAreHandedOnInTheirs) {
  std::mt19937_64 engine(3);
  for (int round = 0; round < 50; ++round) {
    Consumer consumer = of_truth(ClockMode::Lockstep);
    Numbers numbers = from_to(0, 299);
    std::shuffle(numbers.begin(), numbers.end(), engine);
    Numbers taken;
    for (const std::uint64_t number : numbers) {
      consumer.come({number});
      for (const std::uint64_t one : consumer.take()) taken.push_back(one);
    }
    ASSERT_THAT(taken, ElementsAreArray(from_to(0, 299)));
  }
}

TEST(Receiver, OfAPeerThatIsStartedAgainTheStreamGoesOnWithoutASecondCopy) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.come(from_to(0, 99));
  EXPECT_EQ(consumer.take().size(), 100u);
  EXPECT_FALSE(consumer.asks_within(seconds(10)).empty()) << "nobody is there";
  consumer.come(from_to(68, 131));  // it begins with its last checkpoint
  EXPECT_THAT(consumer.take(), ElementsAreArray(from_to(100, 131)));
  EXPECT_EQ(consumer.counts().duplicates, 32u);
}

TEST(Receiver, OneThatJoinsLateAsksForTheBeginning) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  EXPECT_TRUE(consumer.asks());
  consumer.come(from_to(500, 510));
  EXPECT_THAT(consumer.take(), IsEmpty());
  EXPECT_FALSE(consumer.asks_within(milliseconds(250)).empty());
  EXPECT_TRUE(consumer.receiver().has_gap());
  EXPECT_EQ(consumer.receiver().next(), 0u);
  consumer.come(from_to(0, 499));
  EXPECT_THAT(consumer.take(), ElementsAreArray(from_to(0, 510)));
}

TEST(Receiver, OneThatGoesOnForAnotherProcessDoesNotAskForWhatThatOneHad) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.receiver().go_on(200);
  consumer.come(from_to(150, 210));
  EXPECT_THAT(consumer.take(), ElementsAreArray(from_to(200, 210)));
  EXPECT_THAT(consumer.asks_within(seconds(10)), ElementsAre(50)) << "what came before it listened";
  EXPECT_EQ(consumer.counts().lost, 0u);
}

TEST(Receiver, AStreamThatFallsSilentInLockstepIsAskedForAndGoesOnHoweverLongItWas) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come(from_to(0, 31));
  consumer.take();
  const auto asked = consumer.asks_within(seconds(30));
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.front(), 450) << "the first look after 400 ms";
  EXPECT_FALSE(consumer.asks_within(seconds(2)).empty())
      << "it goes on, so that a peer whose lease had run out hears it";
  EXPECT_EQ(consumer.lost(), std::nullopt);
  consumer.come(from_to(32, 63));
  EXPECT_THAT(consumer.take(), ElementsAreArray(from_to(32, 63)));
}

TEST(Receiver, AStreamThatIsSilentInRealTimeIsNotAskedForSinceItsNextSampleShowsWhatIsMissing) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  EXPECT_THAT(consumer.asks_within(seconds(30)), IsEmpty());
}

TEST(Receiver, InVainItAsksLessAndLessOften) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  EXPECT_THAT(consumer.asks_within(seconds(10)), ElementsAre(450, 650, 1050, 1850, 3450, 5050, 6650, 8250, 9850));
}

TEST(Receiver, OfAPeerThatNeverComesItAsksNoMoreThanEveryOtherSecondOrSo) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  const std::size_t asked = consumer.asks_within(seconds(600)).size();
  EXPECT_GT(asked, 300u);
  EXPECT_LT(asked, 400u) << "3000 without a back-off";
  EXPECT_EQ(consumer.lost(), std::nullopt);
  EXPECT_EQ(consumer.counts().samples, 0u);
}

TEST(Receiver, WhatIsNewMakesItAskAsOftenAsAtFirst) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  consumer.asks_within(seconds(20));
  consumer.come({1});
  consumer.take();
  EXPECT_THAT(consumer.asks_within(seconds(2)), ElementsAre(450, 650, 1050, 1850));
}

TEST(Receiver, WhatCameBeforeIsNothingNewAndDoesNotMakeItAskMoreOften) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  consumer.asks_within(milliseconds(3450));
  consumer.come({0});  // somebody else had it sent again
  EXPECT_THAT(consumer.asks_within(seconds(4)), ElementsAre(1600, 3200));
}

TEST(Receiver, WhileItHasWorkItsOwnSilenceIsNoSign) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  consumer.consumer().has_work = true;
  EXPECT_THAT(consumer.asks_within(seconds(10)), IsEmpty());
}

TEST(Receiver, InLockstepItRepeatsHowFarItIsSinceACreditMayGetLost) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  consumer.consumer().has_work = true;
  EXPECT_THAT(consumer.says_within(seconds(2)), ElementsAre(200, 400, 800, 1600));
  consumer.consumer().moved = true;
  EXPECT_THAT(consumer.says_within(milliseconds(100)), ElementsAre(50, 100)) << "at once when it has moved";
}

TEST(Receiver, WhatDoesNotComeForEightSecondsIsGivenUpAndTheTruthDoesNotGoOnWithoutIt) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 3});
  consumer.take();
  consumer.asks_within(seconds(8));
  EXPECT_EQ(consumer.lost(), std::nullopt);
  consumer.asks_within(milliseconds(100));
  EXPECT_THAT(consumer.lost(), Optional(Pair(1u, 2u)));
  EXPECT_THAT(consumer.take(), IsEmpty());
}

TEST(Receiver, PatienceBeginsAnewWithWhatCame) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 3});
  consumer.take();
  consumer.asks_within(seconds(7));
  consumer.come({1});
  consumer.take();
  consumer.asks_within(seconds(7));
  EXPECT_EQ(consumer.lost(), std::nullopt);
  consumer.asks_within(seconds(2));
  EXPECT_THAT(consumer.lost(), Optional(Pair(2u, 2u)));
}

TEST(Receiver, AnAppGoesOnWithoutWhatIsTooLateAndWaitsForEachGapByItself) {
  Consumer consumer = of_input(ClockMode::RealTime);
  consumer.asks();
  consumer.come({0, 2, 4});
  EXPECT_THAT(consumer.take(), ElementsAre(0));
  consumer.asks_within(milliseconds(150));
  EXPECT_THAT(consumer.take(), IsEmpty()) << "within its patience";
  consumer.asks_within(milliseconds(50));
  EXPECT_THAT(consumer.take(), ElementsAre(2));
  consumer.asks_within(milliseconds(150));
  EXPECT_THAT(consumer.take(), IsEmpty());
  consumer.come({3});
  EXPECT_THAT(consumer.take(), ElementsAre(3, 4));
  consumer.come({1});
  EXPECT_THAT(consumer.take(), IsEmpty()) << "its time is over";
  EXPECT_EQ(consumer.lost(), std::nullopt);
}

TEST(Receiver, AProcessThatWasStoppedHasNotWaitedMeanwhile) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 3});
  consumer.take();
  consumer.asks_within(seconds(1));
  consumer.stand_still(seconds(30));
  EXPECT_TRUE(consumer.asks());
  EXPECT_EQ(consumer.lost(), std::nullopt);
  consumer.asks_within(seconds(7));
  EXPECT_EQ(consumer.lost(), std::nullopt);
  consumer.come({1, 2});
  EXPECT_THAT(consumer.take(), ElementsAre(1, 2, 3));
}

// While the lease of a peer has run out nothing of it comes, though it sends; a stream is heard again from then on.
TEST(Receiver, WhatAPeerSentWhileItsLeaseHadRunOutIsAskedForWithItsNextSample) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come(from_to(0, 99));
  consumer.take();
  consumer.asks_within(seconds(30));
  EXPECT_EQ(consumer.lost(), std::nullopt) << "silence is no loss";
  consumer.come(from_to(6100, 6105));
  EXPECT_THAT(consumer.take(), IsEmpty());
  EXPECT_FALSE(consumer.asks_within(seconds(7)).empty());
  EXPECT_EQ(consumer.lost(), std::nullopt) << "patience begins when the gap is seen";
  consumer.come(from_to(100, 6099));
  EXPECT_THAT(consumer.take(), ElementsAreArray(from_to(100, 6105)));
  EXPECT_EQ(consumer.counts().lost, 0u);
}

TEST(Receiver, AnAppGoesOnWithWhatComesWhenALeaseHadRunOut) {
  Consumer consumer = of_input(ClockMode::RealTime);
  consumer.asks();
  consumer.come({0});
  consumer.take();
  consumer.asks_within(seconds(30));
  consumer.come({300, 301});
  consumer.asks_within(milliseconds(200));
  EXPECT_THAT(consumer.take(), ElementsAre(300, 301));
  EXPECT_EQ(consumer.counts().lost, 299u);
}

TEST(Receiver, WhatIsMissingAtTheEndIsAskedForWhenTheEndIsKnown) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.asks();
  consumer.come(from_to(0, 9));
  consumer.take();
  EXPECT_THAT(consumer.asks_within(seconds(10)), IsEmpty()) << "nothing shows it";
  consumer.consumer().sent = 12;
  EXPECT_FALSE(consumer.asks_within(milliseconds(50)).empty());
  consumer.come({10, 11});
  EXPECT_THAT(consumer.take(), ElementsAre(10, 11));
  EXPECT_THAT(consumer.asks_within(seconds(10)), IsEmpty());
}

TEST(Receiver, SamplesOfAnotherRunAreNotItsOwn) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 1});
  consumer.come({2}, kAnotherRun);
  EXPECT_THAT(consumer.take(), ElementsAre(0, 1));
  EXPECT_EQ(consumer.counts().samples, 2u);
}

TEST(Receiver, AnotherRunBeginsWithItsFirstSampleAndNothingIsLeftOfTheOneBefore) {
  Consumer consumer = of_truth(ClockMode::RealTime);
  consumer.come({0, 1, 5});
  consumer.take();
  consumer.receiver().begin_run(kAnotherRun, demand_of_truth(ClockMode::RealTime), consumer.now());
  EXPECT_TRUE(consumer.receiver().empty());
  EXPECT_TRUE(consumer.asks());
  consumer.come({0, 1, 2}, kAnotherRun);
  EXPECT_THAT(consumer.take(), ElementsAre(0, 1, 2));
  EXPECT_EQ(consumer.counts().samples, 3u);
}

TEST(Receiver, BeforeARunItTakesNothingAndAsksForNothing) {
  Receiver<GnssFix> receiver("inslab/gnss/0");
  receiver.add({{GnssFix()}, 0}, seconds(1));
  EXPECT_TRUE(receiver.empty());
  EXPECT_FALSE(receiver.look({}, seconds(1)));
}

TEST(Receiver, SaysWhichSampleWasTheLastOfItsMessage) {
  Consumer consumer = of_truth(ClockMode::Lockstep);
  consumer.come({0, 1});
  Receiver<GnssFix>& receiver = consumer.receiver();
  ASSERT_NE(receiver.front(consumer.now()), nullptr);
  EXPECT_FALSE(receiver.front(consumer.now())->ends_message);
  receiver.pop();
  EXPECT_TRUE(receiver.front(consumer.now())->ends_message);
  receiver.pop();
  EXPECT_EQ(receiver.front(consumer.now()), nullptr);
}

}  // namespace receiver_test
}  // namespace inslab::streams
