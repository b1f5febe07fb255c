#include "app/credit_ledger.hpp"

#include <gtest/gtest.h>

namespace inslab::app {
namespace credit_ledger_test {

const RunId kRun{{1}};

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
  EXPECT_TRUE(ledger.take(credit("logger", 40), kRun));
  EXPECT_EQ(ledger.lowest(), 0U);
  EXPECT_EQ(ledger.slowest(), "injector 0");
  EXPECT_TRUE(ledger.take(credit("injector", 30), kRun));
  EXPECT_EQ(ledger.lowest(), 30U);
}

TEST(CreditLedger, AnotherConsumerCountsFromItsFirstCredit) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 40), kRun);
  ledger.take(credit("stranger", 12), kRun);
  EXPECT_EQ(ledger.lowest(), 12U);
}

TEST(CreditLedger, WithoutConsumersNobodyHoldsTheProducer) {
  EXPECT_EQ(CreditLedger("inslab/truth", {}).lowest(), std::nullopt);
}

TEST(CreditLedger, CreditsOfOtherTopicsAndRunsAreNotItsOwn) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  EXPECT_FALSE(ledger.take(credit("logger", 40, "inslab/imu/0"), kRun));
  EXPECT_FALSE(ledger.take(credit("logger", 40, "inslab/truth", RunId{{2}}), kRun));
  EXPECT_EQ(ledger.lowest(), 0U);
}

TEST(CreditLedger, AConsumerThatIsStartedAgainMayGoBack) {
  CreditLedger ledger("inslab/truth", {{"logger", 0}});
  ledger.take(credit("logger", 40), kRun);
  ledger.take(credit("logger", 10), kRun);
  EXPECT_EQ(ledger.lowest(), 10U);
}

}  // namespace credit_ledger_test
}  // namespace inslab::app
