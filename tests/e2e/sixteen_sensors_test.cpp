// As many sensors as a unit may have, all started at once and all killed at once.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <string>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace sixteen_sensors_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

constexpr int kOfAKind = 8;

class SixteenSensors : public testing::Test {
 protected:
  void SetUp() override {
    std::string imus, receivers;
    for (int number = 0; number < kOfAKind; ++number) {
      const std::string head = std::string(number == 0 ? "" : ", ") + R"({"number": )" + std::to_string(number);
      imus += head + R"(, "rate_hz": 100, "error_profile": ")" + source("config/profiles/imu/stim300.json") + "\"}";
      receivers += head + R"(, "rate_hz": 5, "error_profile": ")" + source("config/profiles/gnss/rtk.json") + "\"}";
    }
    std::ofstream(scenario_) << R"({"name": "sixteen", "seed": 16,
  "start": {"at": "gps_time", "gps_week": 2446, "gps_seconds_of_week_s": 36000}, "duration_s": 12, "truth_rate_hz": 100,
  "trajectory": {"initial": {"latitude_deg": 48.1, "longitude_deg": 11.6, "height_m": 520, "speed_m_per_s": 12},
                 "segments": [{"duration_s": 10, "motions": [{"type": "turn", "angle_deg": 40}]}]},
  "imu": [)" << imus << R"(],
  "gnss": [)" << receivers << R"(],
  "clock": {"max_lag_ms": 60000, "ready_timeout_s": 90}})";
    Process offline("inslab", {"simulate", scenario_, "-o", folder_ / "offline"});
    ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  }

  /// Ends all of them as a crash of their host would; how many there were.
  static std::size_t kill_all(const Process& set) {
    std::size_t killed = 0;
    for (const char* program : {"inslab-imu-injector", "inslab-gnss-emulator"}) {
      for (const pid_t pid : children_named(set.pid(), program)) killed += kill(pid, SIGKILL) == 0 ? 1 : 0;
    }
    return killed;
  }
  static std::size_t times(const std::string& text, const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
    return count;
  }
  void expect_whole_run() const {
    const std::string reference = folder_ / "offline/sixteen.mcap";
    expect_same_bits<TruthState>(log_, reference, "inslab/truth", 1201);
    for (int number = 0; number < kOfAKind; ++number) {
      expect_same_bits<ImuSample>(log_, reference, "inslab/imu/" + std::to_string(number), 1200);
      expect_same_bits<ImuTruth>(log_, reference, "inslab/imu_truth/" + std::to_string(number), 1200);
      expect_same_bits<GnssFix>(log_, reference, "inslab/gnss/" + std::to_string(number), 60);
    }
  }

  const TestFolder folder_;
  const std::string scenario_ = folder_ / "sixteen.json";
  const std::string log_ = folder_ / "live.mcap";
};

TEST_F(SixteenSensors, ThatAreKilledAllAtOnceGoOnAndNoBitIsLost) {
  Process run("inslab", {"run", scenario_, "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(run.prints("sixteen: 3", seconds(120))) << run.output();
  ASSERT_EQ(kill_all(run), 2u * kOfAKind);
  EXPECT_EQ(run.wait(seconds(120)), 0) << run.output();
  EXPECT_GE(times(run.output(), "was ended by signal 9 (Killed) and started again"), 2u * kOfAKind) << run.output();
  EXPECT_THAT(run.output(), Not(HasSubstr("ended by signal 6")));
  expect_whole_run();
}

TEST_F(SixteenSensors, ThatAreKilledAllAtOnceWhileTheyMeetRunAllTheSame) {
  Process run("inslab", {"run", scenario_, "--log", log_, "--domain", own_domain(), "--clock", "lockstep"});
  ASSERT_TRUE(
      eventually([&] { return children_named(run.pid(), "inslab-gnss-emulator").size() == kOfAKind; }, seconds(60)))
      << run.output();
  ASSERT_GT(kill_all(run), 0u);
  EXPECT_EQ(run.wait(seconds(120)), 0) << run.output();
  EXPECT_THAT(run.output(), Not(HasSubstr("ended by signal 6")));
  expect_whole_run();
}

}  // namespace sixteen_sensors_test
}  // namespace inslab::e2e
