#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/sim/offline_run.hpp"

/// Several IMUs and antennas in one unit, each with its own profile, place, rate and streams.
namespace inslab::sim {
namespace multi_sensor_test {

/// Every sample of every stream as bytes, journal revisions aside, by topic.
class StreamRecorder : public RunSink {
 public:
  using Streams = std::map<std::string, std::vector<std::vector<std::uint8_t>>>;

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState& truth) override { keep("truth", truth); }
  void imu(std::size_t, const ImuSample& sample, const ImuTruth& truth) override {
    ImuTruth without = truth;
    without.revisions = {};
    keep("imu" + std::to_string(sample.sensor_number), sample);
    keep("imu_truth" + std::to_string(sample.sensor_number), without);
    imu_truths[sample.sensor_number].push_back(truth);
  }
  void gnss(std::size_t, const GnssFix& fix) override {
    keep("gnss" + std::to_string(fix.sensor_number), fix);
    fixes[fix.sensor_number].push_back(fix);
  }
  void ack(const ProfileAck& ack) override { acks.push_back(ack); }

  Streams streams;
  std::map<std::uint32_t, std::vector<ImuTruth>> imu_truths;
  std::map<std::uint32_t, std::vector<GnssFix>> fixes;
  std::vector<ProfileAck> acks;

 private:
  template <class Sample>
  void keep(const std::string& stream, Sample sample) {
    if constexpr (std::is_same_v<Sample, TruthState>) sample.journal_in_effect = 0;
    if constexpr (std::is_same_v<Sample, ImuSample> || std::is_same_v<Sample, GnssFix>) sample.revisions = {};
    wire::encode(sample, streams[stream].emplace_back());
  }
};

scenario::LoadedScenario two_of_each(const std::string& unit = {}) {
  return scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/two_imus_two_antennas.json", unit);
}

StreamRecorder run(const scenario::LoadedScenario& loaded) {
  StreamRecorder recorder;
  OfflineRun offline(loaded, {2446, 36000'000'000'000}, RunId{}, recorder);
  while (offline.step()) {
  }
  return recorder;
}

std::size_t first_difference(const StreamRecorder& a, const StreamRecorder& b, const std::string& stream) {
  const auto &x = a.streams.at(stream), &y = b.streams.at(stream);
  return static_cast<std::size_t>(std::mismatch(x.begin(), x.end(), y.begin(), y.end()).first - x.begin());
}

TEST(MultiSensor, EachHasItsOwnRateAndPlace) {
  const StreamRecorder all = run(two_of_each());
  EXPECT_EQ(all.streams.at("imu0").size(), 3200U);
  EXPECT_EQ(all.streams.at("imu1").size(), 1600U);
  // At 8 s the vehicle still drives straight and level towards 60 deg: the IMUs' arms are apart by their difference.
  const scenario::LoadedScenario loaded = two_of_each();
  const ImuTruth &at0 = all.imu_truths.at(0)[1599], &at1 = all.imu_truths.at(1)[799];
  ASSERT_EQ(at0.header.sim_time_ns, at1.header.sim_time_ns);
  const Vector3 apart_n = nav::ned_from(geodetic_of(at0), geodetic_of(at1));
  const Vector3 arms_v_m = loaded.imus[1].installation.lever_arm_v_m - loaded.imus[0].installation.lever_arm_v_m;
  EXPECT_NEAR(apart_n.norm(), arms_v_m.norm(), 1e-6);
  EXPECT_GT(arms_v_m.norm(), 0.5);
}

TEST(MultiSensor, EachReceiverHasItsOwnOutages) {
  const StreamRecorder all = run(two_of_each());
  const auto has_fix_at = [&all](std::uint32_t receiver, std::int64_t t_ms) {
    const auto& fixes = all.fixes.at(receiver);
    return std::any_of(fixes.begin(), fixes.end(),
                       [t_ms](const GnssFix& fix) { return fix.header.sim_time_ns == t_ms * 1'000'000; });
  };
  // Receiver 0 is in the tunnel from about 4 s to 7 s; receiver 1 has none for 0.5 s from 2.9 s and 12.9 s on, and 0.5
  // s after.
  EXPECT_TRUE(has_fix_at(0, 3'000));
  EXPECT_FALSE(has_fix_at(0, 5'000));
  EXPECT_TRUE(has_fix_at(1, 5'000));
  EXPECT_FALSE(has_fix_at(1, 3'000));
  EXPECT_FALSE(has_fix_at(1, 13'200));
  EXPECT_TRUE(has_fix_at(0, 13'200));
}

TEST(MultiSensor, ASwapGoesToTheSensorItNamesAndToNoOther) {
  const scenario::LoadedScenario with_swaps = two_of_each();
  scenario::LoadedScenario without = with_swaps;
  without.swaps.clear();
  const StreamRecorder swapped = run(with_swaps), plain = run(without);
  ASSERT_EQ(swapped.acks.size(), 3U);
  for (const ProfileAck& ack : swapped.acks) {
    ASSERT_EQ(ack.outcome, AckOutcome::Applied);
    EXPECT_EQ(first_difference(swapped, plain, catalog::sensor_name(ack.target)), ack.first_sequence)
        << catalog::sensor_name(ack.target);
  }
  EXPECT_EQ(first_difference(swapped, plain, "gnss0"), plain.streams.at("gnss0").size());
  EXPECT_EQ(first_difference(swapped, plain, "truth"), plain.streams.at("truth").size());
}

TEST(MultiSensor, ASensorMoreChangesNoOther) {
  const scenario::LoadedScenario both = two_of_each();
  scenario::LoadedScenario one = both;
  one.imus.pop_back();
  one.gnss.pop_back();
  one.scenario.imu.pop_back();
  one.scenario.gnss.pop_back();
  one.swaps = {both.swaps[2]};
  const StreamRecorder with = run(both), without = run(one);
  for (const std::string stream : {"truth", "imu0", "imu_truth0", "gnss0"}) {
    EXPECT_EQ(first_difference(with, without, stream), with.streams.at(stream).size()) << stream;
  }
}

TEST(MultiSensor, RunsInParallelThreadsGiveTheBitsOfOneAlone) {
  const scenario::LoadedScenario loaded = two_of_each();
  const StreamRecorder alone = run(loaded);
  std::vector<StreamRecorder> side_by_side(3);
  std::vector<std::thread> threads;
  for (StreamRecorder& recorder : side_by_side) {
    threads.emplace_back([&recorder, &loaded] { recorder = run(loaded); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const StreamRecorder& recorder : side_by_side) EXPECT_TRUE(recorder.streams == alone.streams);
}

TEST(MultiSensor, UnitsOfOneScenarioShareTheTruthAndNoError) {
  const StreamRecorder alpha = run(two_of_each("alpha")), beta = run(two_of_each("beta")),
                       nameless = run(two_of_each());
  EXPECT_TRUE(alpha.streams.at("truth") == beta.streams.at("truth"));
  for (const std::string stream : {"imu0", "imu1", "gnss0", "gnss1"}) {
    EXPECT_EQ(first_difference(alpha, beta, stream), 0U) << stream;
    EXPECT_EQ(first_difference(alpha, nameless, stream), 0U) << stream;
  }
  EXPECT_TRUE(run(two_of_each("alpha")).streams == alpha.streams);
}

}  // namespace multi_sensor_test
}  // namespace inslab::sim
