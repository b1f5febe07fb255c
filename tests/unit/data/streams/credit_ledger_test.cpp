#include "inslab/data/streams/credit_ledger.hpp"

#include <gtest/gtest.h>

namespace inslab::streams {
namespace credit_ledger_test {

using std::chrono::seconds;

const RunId kRun{{1}};
constexpr time::Nanoseconds kNow = seconds(100);

Credit credit(const std::string& consumer, std::uint64_t next, const std::string& topic = "inslab/truth",
              const RunId& run = kRun) {
  Credit credit;
  credit.run_id = run;
  credit.consumer = consumer;
  credit.topic = topic;
  credit.next_sequence = next;
  return credit;
}

TEST(CreditLedger, ExpectedConsumersWantEverythingUntilTheySayOtherwise) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}, {"injector", 0}});
  EXPECT_EQ(ledger.lowest(), 0U);
  EXPECT_TRUE(ledger.take(credit("logger", 40), kRun, kNow));
  EXPECT_EQ(ledger.lowest(), 0U);
  EXPECT_EQ(ledger.slowest(), "injector 0");
  EXPECT_TRUE(ledger.take(credit("injector", 30), kRun, kNow));
  EXPECT_EQ(ledger.lowest(), 30U);
}

TEST(CreditLedger, AnotherConsumerCountsFromItsFirstCredit) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 40), kRun, kNow);
  ledger.take(credit("stranger", 12), kRun, kNow);
  EXPECT_EQ(ledger.lowest(), 12U);
}

TEST(CreditLedger, WithoutConsumersNobodyHoldsTheProducer) {
  EXPECT_EQ(CreditLedger("inslab/truth", {}).lowest(), std::nullopt);
}

TEST(CreditLedger, CreditsOfOtherTopicsAndRunsAreNotItsOwn) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  EXPECT_FALSE(ledger.take(credit("logger", 40, "inslab/imu/0"), kRun, kNow));
  EXPECT_FALSE(ledger.take(credit("logger", 40, "inslab/truth", RunId{{2}}), kRun, kNow));
  EXPECT_EQ(ledger.lowest(), 0U);
}

TEST(CreditLedger, AConsumerThatIsStartedAgainMayGoBack) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 40), kRun, kNow);
  ledger.take(credit("logger", 10), kRun, kNow);
  EXPECT_EQ(ledger.lowest(), 10U);
}

TEST(CreditLedger, WhoWasNotExpectedAndDoesNotComeOnIsLeftBehindUntilItDoes) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 40), kRun, kNow);
  ledger.take(credit("ghost", 12), kRun, kNow);
  EXPECT_EQ(ledger.leave_behind(60, kNow + CreditLedger::kPatience), "");
  const time::Nanoseconds later = kNow + CreditLedger::kPatience + seconds(1);
  ledger.take(credit("ghost", 12), kRun, later);  // it speaks, and stands where it stood
  EXPECT_EQ(ledger.leave_behind(60, later), "ghost 0");
  EXPECT_EQ(ledger.lowest(), 40U);
  EXPECT_EQ(ledger.leave_behind(60, later), "") << "said once";
  ledger.take(credit("ghost", 13), kRun, later);
  EXPECT_EQ(ledger.lowest(), 13U);
}

TEST(CreditLedger, WhoIsExpectedOrHasEverythingIsNeverLeftBehind) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 12), kRun, kNow);
  ledger.take(credit("app", 40), kRun, kNow);
  EXPECT_EQ(ledger.leave_behind(40, kNow + seconds(1000)), "");
  EXPECT_EQ(ledger.lowest(), 12U);
}

TEST(CreditLedger, OfThoseWhoWereNotExpectedItKeepsSoMany) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  for (std::size_t i = 0; i < 1000; ++i) ledger.take(credit("ghost" + std::to_string(i), 40), kRun, kNow);
  EXPECT_FALSE(ledger.take(credit("one more", 12), kRun, kNow));
  EXPECT_EQ(ledger.lowest(), 0U) << "the logger's";
}

}  // namespace credit_ledger_test
}  // namespace inslab::streams
