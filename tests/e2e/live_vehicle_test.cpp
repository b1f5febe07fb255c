#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace live_vehicle_test {

using std::chrono::seconds;
using testing::HasSubstr;

/// The example of a dynamics simulator and a run of the whole set that follows it.
class LiveVehicle : public testing::Test {
 protected:
  void run_with(std::vector<std::string> trouble) {
    trouble.insert(trouble.end(), {"--domain", own_domain()});
    setenv("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml").c_str(), 1);
    Process simulator("vehicle_simulator", trouble);
    unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
    Process set("inslab", {"run", scenario_, "--domain", own_domain(), "--log", log_});
    // Exit 0 also means that every sample of every stream is in the log.
    ASSERT_EQ(set.wait(seconds(60)), 0) << set.output() << simulator.output();
    EXPECT_EQ(simulator.wait(seconds(20)), 0) << simulator.output();
    EXPECT_THAT(simulator.output(), HasSubstr("states sent"));
    link_ = last<VehicleLink>("inslab/vehicle_link");
  }

  template <class T>
  T last(const std::string& topic) const {
    const mcap::McapReader log(log_);
    T latest;
    log.for_each([&](const mcap::Message& message) {
      if (log.channels().at(message.channel_id).topic == topic) wire::decode(message.data, message.size, latest);
      return true;
    });
    return latest;
  }

  template <class T>
  void expect_same_bits(const std::string& other_log, const std::string& topic, std::size_t count) const {
    const std::vector<T> live = samples_of<T>(log_, topic);
    const std::vector<T> again = samples_of<T>(other_log, topic);
    ASSERT_EQ(live.size(), count) << topic;
    ASSERT_EQ(again.size(), count) << topic;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(comparable_bytes(live[i]), comparable_bytes(again[i])) << topic << " sample " << i;
    }
  }

  TestFolder folder_;
  std::string scenario_ = source("tests/data/live.json");
  std::string log_ = folder_ / "live.mcap";
  VehicleLink link_;
};

TEST_F(LiveVehicle, WithJitterLossAndSilenceIsFollowedAndRepeatsToTheSameBits) {
  run_with({"--jitter", "15", "--loss", "0.1", "--silence", "3", "0.3"});
  // 600 states less 30 of the silence, and a tenth of the rest at random: 57 with a standard deviation of 7. What comes
  // out of order is left out too: two neighbours change places when the first is held up by 10 ms more than the second,
  // with probability (1 - 10/15)^2/2 = 1/18: 30 more.
  EXPECT_GT(link_.used, 400u);
  EXPECT_GT(link_.missing, 30u + 25u);
  EXPECT_EQ(link_.refused, 0u);
  EXPECT_EQ(link_.used + link_.not_newer, link_.received);
  // The silence, less the latency that bridges its beginning: at least a quarter of a second, 50 samples at 200 Hz.
  EXPECT_GE(link_.truth_samples_extrapolated, 50u);
  EXPECT_GE(link_.longest_extrapolation_s, 0.25);
  EXPECT_GE(link_.returns, 1u);

  Process offline("inslab", {"simulate", scenario_, "--vehicle", log_, "-o", folder_ / "again"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  const std::string again = folder_ / "again/live.mcap";
  expect_same_bits<TruthState>(again, "inslab/truth", 1201);
  expect_same_bits<ImuSample>(again, "inslab/imu/0", 1200);
  expect_same_bits<ImuTruth>(again, "inslab/imu_truth/0", 1200);
  expect_same_bits<GnssFix>(again, "inslab/gnss/0", 30);
  expect_same_bits<UsedVehicleState>(again, "inslab/vehicle_state_used", link_.used);
}

TEST_F(LiveVehicle, TruthOfAnUntroubledRunIsTheStatesLatencyAgo) {
  run_with({});
  const std::vector<UsedVehicleState> used = samples_of<UsedVehicleState>(log_, "inslab/vehicle_state_used");
  const std::vector<TruthState> truth = samples_of<TruthState>(log_, "inslab/truth");
  std::size_t compared = 0;
  std::int64_t calm_from_ns = 0;
  for (const UsedVehicleState& state : used) {
    const std::int64_t at_ns = state.state.sim_time_ns + 30'000'000;
    // Where the machine held a state up past the first sample that needed it, the truth was extrapolated; two seconds
    // later the offset has died out to e^-42.
    const bool was_late = state.header.sim_time_ns > at_ns - 10'000'000 + 5'000'000;
    if (was_late) calm_from_ns = at_ns + 2'000'000'000;
    const auto k = static_cast<std::size_t>(at_ns / 5'000'000);
    if (at_ns < calm_from_ns || k >= truth.size()) continue;
    ASSERT_EQ(truth[k].header.sim_time_ns, at_ns);
    // The offset that the angles' rounding leaves, led back 21/s fast; see the test of the model.
    ASSERT_LT((truth[k].v_n - state.state.v_n).norm(), 1e-6) << k;
    ASSERT_LT((truth[k].q_nv.coeffs() - state.state.q_nv.coeffs()).norm(), 1e-14) << k;
    ++compared;
  }
  EXPECT_GT(compared, 0u);
}

TEST_F(LiveVehicle, IsOneAndASecondIsAFaultAndLeftOut) {
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml").c_str(), 1);
  Process first("vehicle_simulator", {"--domain", own_domain()});
  Process second("vehicle_simulator", {"--domain", own_domain()});
  unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  Process set("inslab", {"run", scenario_, "--domain", own_domain(), "--log", log_});
  EXPECT_TRUE(set.prints("inslab/vehicle_state: a second writer beside ", seconds(60))) << set.output();
  EXPECT_EQ(set.wait(seconds(60)), 1) << set.output();
  // The second is known when the first writes on, and may have sent in one go what it was behind until then. Of two
  // that were followed in turns every state would come twice, to the end.
  constexpr std::int64_t kSettled_ns = 4'000'000'000;
  std::map<std::int64_t, int> times;
  for (const auto& state : samples_of_kind<VehicleState>(log_, "inslab/vehicle_state")) {
    if (state.sim_time_ns > kSettled_ns) ++times[state.sim_time_ns];
  }
  EXPECT_GT(times.size(), 100u);
  for (const auto& [sim_time_ns, count] : times) EXPECT_EQ(count, 1) << sim_time_ns;
}

TEST_F(LiveVehicle, CannotBeSimulatedOfflineWithoutTheLogOfALiveRun) {
  Process offline("inslab", {"simulate", scenario_, "-o", folder_ / "out"});
  EXPECT_EQ(offline.wait(seconds(20)), 2);
  EXPECT_THAT(offline.output(), HasSubstr("to repeat a live run give its log, --vehicle LOG"));
}

}  // namespace live_vehicle_test
}  // namespace inslab::e2e
