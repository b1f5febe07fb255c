#include "inslab/sim/run_clock.hpp"

#include <gtest/gtest.h>

namespace inslab::sim {
namespace run_clock_test {

using namespace std::chrono_literals;
using time::Nanoseconds;

TEST(RunClock, AtRateOneDeadlinesAreSimTimeAfterZeroToTheNanosecond) {
  const RunClock clock(1'000ns, 1.0);
  const Nanoseconds week = 7 * 24h + 1ns;
  EXPECT_EQ(clock.deadline(0ns), 1'000ns);
  EXPECT_EQ(clock.deadline(week), 1'000ns + week);
  EXPECT_EQ(clock.sim_time(1'000ns + week), week);
}

TEST(RunClock, AtAnotherRateSimTimeGoesThatMuchFaster) {
  const RunClock clock(10s, 5.0);
  EXPECT_EQ(clock.deadline(5s), 11s);
  EXPECT_EQ(clock.sim_time(12s), 10s);
}

TEST(RunClock, StandsStillWhilePausedAndGoesOnFromThere) {
  RunClock clock(0s, 1.0);
  clock.pause(3s);
  EXPECT_EQ(clock.sim_time(8s), 3s);
  clock.resume(10s);
  EXPECT_EQ(clock.deadline(4s), 11s);
}

TEST(RunClock, AChangeOfRateBendsTheLineWhereItIsMade) {
  RunClock clock(0s, 1.0);
  clock.set_rate(4s, 2.0);
  EXPECT_EQ(clock.sim_time(4s), 4s);
  EXPECT_EQ(clock.deadline(6s), 5s);
  clock.set_rate(5s, 0.5);
  EXPECT_EQ(clock.deadline(7s), 7s);
}

TEST(RunClock, AChangeOfRateWhilePausedCountsFromTheResumption) {
  RunClock clock(0s, 1.0);
  clock.pause(2s);
  clock.set_rate(3s, 4.0);
  EXPECT_EQ(clock.sim_time(9s), 2s);
  clock.resume(10s);
  EXPECT_EQ(clock.deadline(6s), 11s);
}

}  // namespace run_clock_test
}  // namespace inslab::sim
