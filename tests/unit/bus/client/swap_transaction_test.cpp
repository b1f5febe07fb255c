#include "inslab/bus/client/swap_transaction.hpp"

#include <gmock/gmock.h>

#include "tests/unit/bus/client/fake_link.hpp"

namespace inslab::client {
namespace swap_transaction_test {

using testing::HasSubstr;
using testing::IsEmpty;

/// Plays swaps on a set that a script drives: `at(k)` is called at the k-th rest, each of a second.
class SwapTransaction : public testing::Test {
 protected:
  SwapsPlayed play(const std::vector<catalog::AnyProfile>& swaps, std::optional<double> timeout_s = {}) {
    const Pace pace{[this] { return now_; },
                    [this] {
                      now_ += std::chrono::seconds(1);
                      ++rests_;
                      if (at_) at_(rests_);
                    },
                    [this] { return interrupted_; }};
    return play_swaps(
        link_, swaps, timeout_s, "domain 7", [this](const ProfileAck& ack) { told_.push_back(ack); }, pace);
  }

  test::FakeLink link_;
  std::function<void(int)> at_;
  int rests_ = 0;
  bool interrupted_ = false;
  time::Nanoseconds now_{0};
  std::vector<ProfileAck> told_;
};

TEST_F(SwapTransaction, SendsEachSwapAndTellsEachAnswer) {
  at_ = [this](int k) {
    link_.hear(RunState::Running, k);
    if (k == 2) link_.answer(11, AckOutcome::Applied);
    if (k == 4) link_.answer(12, AckOutcome::Applied);
  };
  const SwapsPlayed played = play({test::imu_swap(11), test::imu_swap(12)});
  EXPECT_TRUE(played.in_effect);
  EXPECT_THAT(played.failure, IsEmpty());
  EXPECT_EQ(link_.requests.size(), 2u);
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_EQ(told_[1].request_id, 12u);
}

TEST_F(SwapTransaction, IsNotInEffectWhenOneIsRejected) {
  link_.answer(11, AckOutcome::Rejected);
  link_.answer(12, AckOutcome::Applied);
  const SwapsPlayed played = play({test::imu_swap(11), test::imu_swap(12)});
  EXPECT_FALSE(played.in_effect);
  EXPECT_THAT(played.failure, IsEmpty());
  EXPECT_EQ(told_.size(), 2u) << "the others are still waited for";
}

TEST_F(SwapTransaction, IsNotInEffectWhenALaterSwapTookItsPlace) {
  link_.answer(11, AckOutcome::Superseded);
  EXPECT_FALSE(play({test::imu_swap(11)}).in_effect);
}

TEST_F(SwapTransaction, SaysWhereNoServerWasFound) {
  link_.is_connected = false;
  const SwapsPlayed played = play({test::imu_swap(11)}, 3.0);
  EXPECT_EQ(played.failure, "a trajectory server on domain 7 was not found");
  EXPECT_EQ(rests_, 4) << "seconds of patience";
  EXPECT_THAT(link_.requests, IsEmpty());
}

TEST_F(SwapTransaction, WaitsAsLongAsTheRunGoesOn) {
  at_ = [this](int k) {
    link_.hear(RunState::Running, k);
    if (k == 100) link_.answer(11, AckOutcome::Applied);
  };
  EXPECT_TRUE(play({test::imu_swap(11)}).in_effect);
  EXPECT_EQ(rests_, 100);
}

TEST_F(SwapTransaction, WaitsNoLongerThanItsTimeoutThoughTheRunGoesOn) {
  at_ = [this](int k) { link_.hear(RunState::Running, k); };
  const SwapsPlayed played = play({test::imu_swap(11)}, 5.0);
  EXPECT_EQ(rests_, 6);
  EXPECT_EQ(played.failure,
            "not acknowledged: the first sample of imu0 under the swap; the run is running at 6.0 s did not come");
}

TEST_F(SwapTransaction, WaitsTenSecondsBeyondTheLastWordOfTheRun) {
  at_ = [this](int k) {
    if (k <= 20) link_.hear(RunState::Running, k);
  };
  EXPECT_THAT(play({test::imu_swap(11)}).failure, HasSubstr("not acknowledged"));
  EXPECT_EQ(rests_, 31);
}

TEST_F(SwapTransaction, WaitsTwoSecondsBeyondTheEndOfTheRun) {
  at_ = [this](int k) {
    if (k <= 20) link_.hear(k < 20 ? RunState::Running : RunState::Finished, k);
  };
  EXPECT_THAT(play({test::imu_swap(11)}).failure, HasSubstr("the run is finished at 20.0 s"));
  EXPECT_EQ(rests_, 23);
}

TEST_F(SwapTransaction, EndsWhenItIsInterrupted) {
  at_ = [this](int k) { interrupted_ = k == 3; };
  EXPECT_THAT(play({test::imu_swap(11)}).failure, HasSubstr("not acknowledged"));
  EXPECT_EQ(rests_, 3);
}

TEST_F(SwapTransaction, SaysWhatCouldNotBeSent) {
  link_.takes_requests = false;
  EXPECT_EQ(play({test::imu_swap(11)}).failure, "a request could not be sent");
}

TEST(SwapWords, SayWhenASwapIsInEffectOrWhyItIsNot) {
  ProfileAck ack;
  ack.outcome = AckOutcome::Applied;
  ack.apply_time_ns = 20'000'000'000;
  ack.first_sample_time_ns = 20'005'000'000;
  ack.first_sequence = 4001;
  EXPECT_EQ(words_of(ack), "applied at 20.000000000 s; first sample under it 20.005000000 s, sequence 4001");
  ack.outcome = AckOutcome::Rejected;
  ack.field = "/name";
  ack.reason = "is empty\n";
  EXPECT_THAT(words_of(ack), HasSubstr("rejected: /name: is empty"));
  EXPECT_THAT(words_of(ack), testing::Not(HasSubstr("\n"))) << "what others say stays in its line";
}

}  // namespace swap_transaction_test
}  // namespace inslab::client
