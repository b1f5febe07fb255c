#include "inslab/referee/score/solution_order.hpp"

#include <gtest/gtest.h>

#include "tests/unit/referee/score/straight_run.hpp"

namespace inslab::score {
namespace solution_order_test {

/// One second is a leap; the truth is at 10 s unless said otherwise.
class SolutionOrderTest : public testing::Test {
 protected:
  void add(double t_s, double newest_truth_s = 10.0) { order_.add({ns(t_s), {}}, ns(newest_truth_s), counts_); }

  std::vector<std::int64_t> taken_up_to(double t_s) {
    std::vector<std::int64_t> times_ns;
    while (const auto dated = order_.take(ns(t_s))) times_ns.push_back(dated->sim_time_ns);
    return times_ns;
  }
  static std::vector<std::int64_t> times(std::initializer_list<double> seconds) {
    std::vector<std::int64_t> times_ns;
    for (const double t_s : seconds) times_ns.push_back(ns(t_s));
    return times_ns;
  }

  SolutionOrder order_{100, ns(1.0)};
  SolutionCounts counts_;
};

TEST_F(SolutionOrderTest, GivesWhatIsDueInOrder) {
  add(9.8);
  add(9.9);
  add(10.0);
  EXPECT_EQ(taken_up_to(9.9), times({9.8, 9.9}));
  EXPECT_EQ(taken_up_to(20.0), times({10.0}));
}

TEST_F(SolutionOrderTest, CountsTheSameTimeTwiceAndTimesThatGoBack) {
  add(9.8);
  add(9.8);
  add(9.7);
  EXPECT_EQ(counts_.duplicates, 1u);
  EXPECT_EQ(counts_.out_of_order, 1u);
  EXPECT_EQ(taken_up_to(20.0), times({9.8}));
}

TEST_F(SolutionOrderTest, ALeapThatTheAppTakesBackIsOfTheFutureAndSpoilsNothing) {
  add(9.9);
  add(50.0);
  add(10.0);
  add(10.1);
  EXPECT_EQ(counts_.future, 1u);
  EXPECT_EQ(counts_.out_of_order, 0u);
  EXPECT_EQ(taken_up_to(60.0), times({9.9, 10.0, 10.1}));
}

TEST_F(SolutionOrderTest, SeveralLeapsInARowAreTakenBackTogether) {
  add(9.9);
  add(50.0);
  add(50.1);
  add(50.1);
  add(10.0);
  EXPECT_EQ(counts_.future, 2u);
  EXPECT_EQ(counts_.duplicates, 1u);
  EXPECT_EQ(taken_up_to(60.0), times({9.9, 10.0}));
}

TEST_F(SolutionOrderTest, AnAppThatIsAheadOfTheTruthWeHaveHeardIsInOrder) {
  for (const double t_s : {14.0, 14.1, 14.2}) add(t_s);
  EXPECT_EQ(taken_up_to(13.0), times({}));
  EXPECT_EQ(taken_up_to(14.1), times({14.0, 14.1}));
  add(14.3, 14.1);
  EXPECT_EQ(taken_up_to(20.0), times({14.2, 14.3}));
  EXPECT_EQ(counts_.future + counts_.out_of_order + counts_.duplicates, 0u);
}

TEST_F(SolutionOrderTest, ALeapThatTheTruthReachesIsInOrder) {
  add(9.9);
  add(15.0);
  add(15.1, 15.05);
  add(14.9, 15.05);
  EXPECT_EQ(counts_.out_of_order, 1u);
  EXPECT_EQ(taken_up_to(20.0), times({9.9, 15.0, 15.1}));
}

TEST_F(SolutionOrderTest, LetsNoMoreWaitThanItMay) {
  for (int k = 0; k < 103; ++k) add(9.0 + 0.001 * k);
  EXPECT_EQ(counts_.too_many, 3u);
  EXPECT_EQ(taken_up_to(20.0).size(), 100u);
}

TEST_F(SolutionOrderTest, WhatTheTruthNeverReachesIsOfTheFuture) {
  add(10.0);
  add(10.5);
  add(30.0);
  taken_up_to(10.0);
  order_.finish(counts_);
  EXPECT_EQ(counts_.future, 2u);
}

}  // namespace solution_order_test
}  // namespace inslab::score
