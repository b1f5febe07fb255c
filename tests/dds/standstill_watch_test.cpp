#include "inslab/bus/dds/standstill_watch.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

namespace inslab::dds {
namespace standstill_watch_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// In a process of its own, which is stopped for `stopped` and ended by SIGTERM later: how often it noticed.
int noticed_in_a_process_that_is_stopped(milliseconds stopped) {
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<int> noticed{0};
    const StandstillWatch watch(seconds(3), [&noticed] { ++noticed; });
    const auto end = std::chrono::steady_clock::now() + milliseconds(3000) + stopped;
    while (std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(milliseconds(20));
    _exit(noticed.load());
  }
  std::this_thread::sleep_for(milliseconds(500));
  kill(child, SIGSTOP);
  std::this_thread::sleep_for(stopped);
  kill(child, SIGCONT);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status);
}

TEST(StandstillWatch, NoticesOnceThatItsProcessWasStopped) {
  EXPECT_EQ(noticed_in_a_process_that_is_stopped(milliseconds(7000)), 1);
}

TEST(StandstillWatch, EndsAtOnceAndSaysNothingOfAProcessThatGoesOn) {
  int noticed = 0;
  const auto begun = std::chrono::steady_clock::now();
  {
    const StandstillWatch watch(seconds(5), [&noticed] { ++noticed; });
    std::this_thread::sleep_for(milliseconds(1500));
  }
  EXPECT_EQ(noticed, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, seconds(4));
}

}  // namespace standstill_watch_test
}  // namespace inslab::dds
