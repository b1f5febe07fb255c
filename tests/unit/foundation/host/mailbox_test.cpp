#include "inslab/foundation/host/mailbox.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace inslab::host {
namespace mailbox_test {

using namespace std::chrono_literals;

TEST(Mailbox, GivesMessagesInTheirOrder) {
  Mailbox<int> mailbox;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(mailbox.put(i));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mailbox.take(0ns), i);
}

TEST(Mailbox, GivesNothingAfterItsTimeout) {
  Mailbox<int> mailbox;
  EXPECT_EQ(mailbox.take(0ns), std::nullopt);
  EXPECT_EQ(mailbox.take(1ms), std::nullopt);
}

TEST(Mailbox, LosesAndCountsWhatDoesNotFitAndNeverWaits) {
  Mailbox<int> mailbox(2);
  EXPECT_TRUE(mailbox.put(1));
  EXPECT_TRUE(mailbox.put(2));
  EXPECT_FALSE(mailbox.put(3));
  EXPECT_EQ(mailbox.dropped(), 1U);
  EXPECT_EQ(mailbox.take(0ns), 1);
  EXPECT_TRUE(mailbox.put(4));
  EXPECT_EQ(mailbox.take(0ns), 2);
  EXPECT_EQ(mailbox.take(0ns), 4);
  EXPECT_EQ(mailbox.deepest(), 2U);
}

TEST(Mailbox, TakesMessagesThatCannotBeCopied) {
  Mailbox<std::unique_ptr<int>> mailbox;
  mailbox.put(std::make_unique<int>(7));
  const auto message = mailbox.take(0ns);
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(**message, 7);
}

TEST(Mailbox, KeepsEachSendersOrderAndLosesNothingBetweenThreads) {
  constexpr int kSenders = 4;
  constexpr int kMessages = 5000;
  Mailbox<std::pair<int, int>> mailbox;
  std::vector<std::thread> senders;
  for (int sender = 0; sender < kSenders; ++sender) {
    senders.emplace_back([&mailbox, sender] {
      for (int i = 0; i < kMessages; ++i) mailbox.put({sender, i});
    });
  }
  std::vector<int> next(kSenders, 0);
  int received = 0;
  while (received < kSenders * kMessages) {
    // The deadline only ends a test that failed.
    const auto message = mailbox.take(10s);
    if (!message) break;
    EXPECT_EQ(message->second, next[static_cast<std::size_t>(message->first)]++);
    ++received;
  }
  for (std::thread& sender : senders) sender.join();
  EXPECT_EQ(received, kSenders * kMessages);
  EXPECT_EQ(mailbox.dropped(), 0U);
}

}  // namespace mailbox_test
}  // namespace inslab::host
