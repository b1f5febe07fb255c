#include "inslab/sim/offline_run.hpp"

#include <gtest/gtest.h>

#include "inslab/data/wire/cdr.hpp"
#include "tests/unit/sim/run_recorder.hpp"

namespace inslab::sim {
namespace offline_run_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Ten seconds of a vehicle that turns, one IMU and one receiver, every random term on.
scenario::LoadedScenario turning(double imu_rate_hz = 200.0) {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.name = "turning";
  s.seed = 7;
  s.duration_s = 10.0;
  s.trajectory.initial.latitude_deg = 30.0;
  s.trajectory.initial.speed_m_per_s = 10.0;
  scenario::Motion turn;
  turn.type = scenario::MotionType::Turn;
  turn.angle_deg = 90.0;
  s.trajectory.segments.push_back({"turn", 10.0, {turn}, true});
  loaded.truth_samples = 2001;
  scenario::LoadedImu imu;
  imu.rate = time::Rate(imu_rate_hz);
  imu.errors.name = "first";
  imu.errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  imu.errors.gyro.bias_gm_sigma_deg_per_h.setConstant(10.0);
  imu.errors.gyro.bias_gm_correlation_time_s.setConstant(100.0);
  imu.errors.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.05);
  loaded.imus.push_back(imu);
  scenario::LoadedGnss gnss;
  gnss.rate = time::Rate(10.0);
  gnss.installation.target = gnss.nominal_installation.target = {SensorKind::Gnss, 0};
  gnss.errors.position_sigma_ned_m.setConstant(0.5);
  gnss.errors.velocity_sigma_ned_m_per_s.setConstant(0.05);
  loaded.gnss.push_back(gnss);
  return loaded;
}

template <class Profile>
catalog::AnyProfile at(double apply_at_s, Profile profile) {
  profile.request.request_id = 1;
  profile.request.apply_at_ns = time::from_seconds(apply_at_s).count();
  return profile;
}

ImuErrorProfile noisier(const scenario::LoadedScenario& loaded) {
  ImuErrorProfile profile = loaded.imus.front().errors;
  profile.name = "second";
  profile.gyro.arw_deg_per_sqrt_h.setConstant(1.0);
  return profile;
}

test::RunRecorder run(const scenario::LoadedScenario& loaded) {
  test::RunRecorder recorder;
  OfflineRun offline(loaded, {2400, 0}, RunId{}, recorder);
  while (offline.step()) {
  }
  return recorder;
}

/// The sample as bytes, journal revisions aside.
template <class Sample>
std::vector<std::uint8_t> bytes_of(Sample sample) {
  if constexpr (!std::is_same_v<Sample, TruthState>) sample.revisions = {};
  if constexpr (std::is_same_v<Sample, TruthState>) sample.journal_in_effect = 0;
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

/// Index of the first sample that differs; the size when none does.
template <class Sample>
std::size_t first_difference(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (bytes_of(a[i]) != bytes_of(b[i])) return i;
  }
  return a.size();
}

TEST(OfflineRun, GivesEverySampleOfEveryStream) {
  const test::RunRecorder all = run(turning());
  EXPECT_EQ(all.truths.size(), 2001U);
  EXPECT_EQ(all.samples.size(), 2000U);
  EXPECT_EQ(all.imu_truths.size(), 2000U);
  EXPECT_GE(all.fixes.size(), 100U);
  for (std::size_t i = 0; i < all.samples.size(); ++i) ASSERT_EQ(all.samples[i].header.sequence_number, i);
}

TEST(OfflineRun, GivesTheSameBitsTwice) {
  auto loaded = turning();
  loaded.swaps = {at(4.0, noisier(loaded))};
  const test::RunRecorder a = run(loaded);
  const test::RunRecorder b = run(loaded);
  EXPECT_EQ(first_difference(a.truths, b.truths), a.truths.size());
  EXPECT_EQ(first_difference(a.samples, b.samples), a.samples.size());
  EXPECT_EQ(first_difference(a.imu_truths, b.imu_truths), a.imu_truths.size());
  EXPECT_EQ(first_difference(a.fixes, b.fixes), a.fixes.size());
}

TEST(OfflineRun, AnotherSeedGivesOtherNoiseAndTheSameTruth) {
  auto loaded = turning();
  const test::RunRecorder a = run(loaded);
  loaded.scenario.seed = 8;
  const test::RunRecorder b = run(loaded);
  EXPECT_EQ(first_difference(a.truths, b.truths), a.truths.size());
  EXPECT_EQ(first_difference(a.samples, b.samples), 0U);
  EXPECT_EQ(first_difference(a.fixes, b.fixes), 0U);
}

TEST(OfflineRun, ASwapIsExactToTheSampleAndTouchesNothingElse) {
  auto loaded = turning();
  const test::RunRecorder without = run(loaded);
  loaded.swaps = {at(4.0, noisier(loaded))};
  const test::RunRecorder with = run(loaded);
  // At 200 Hz sample k is the interval (k/200 s, (k+1)/200 s]: the first that begins at 4 s is number 800.
  ASSERT_EQ(with.acks.size(), 1U);
  EXPECT_EQ(with.acks[0].outcome, AckOutcome::Applied);
  EXPECT_EQ(with.acks[0].first_sequence, 800U);
  EXPECT_EQ(with.acks[0].first_sample_time_ns, 4 * kSecond_ns + 5'000'000);
  EXPECT_EQ(first_difference(without.samples, with.samples), 800U);
  for (std::size_t i = 0; i < with.samples.size(); ++i) {
    ASSERT_EQ(with.samples[i].revisions.imu_error, i < 800 ? 0U : 1U) << i;
    ASSERT_EQ(with.samples[i].revisions.vibration, 0U);
  }
  EXPECT_EQ(first_difference(without.truths, with.truths), without.truths.size());
  EXPECT_EQ(first_difference(without.fixes, with.fixes), without.fixes.size());
}

TEST(OfflineRun, ASwapToTheSameParametersIsUnchangedToTheBit) {
  auto loaded = turning();
  const test::RunRecorder without = run(loaded);
  loaded.swaps = {at(4.0, loaded.imus.front().errors)};
  const test::RunRecorder with = run(loaded);
  ASSERT_EQ(with.acks.size(), 1U);
  EXPECT_EQ(with.acks[0].outcome, AckOutcome::Unchanged);
  EXPECT_EQ(first_difference(without.samples, with.samples), without.samples.size());
  EXPECT_EQ(with.samples.back().revisions.imu_error, 0U);
}

TEST(OfflineRun, AnImuSlowerThanTheTruthSwapsBetweenItsOwnIntervals) {
  auto loaded = turning(50.0);
  const test::RunRecorder without = run(loaded);
  // 4.005 s lies inside the IMU's interval (4.00, 4.02]: the first that begins later is number 201, (4.02, 4.04].
  loaded.swaps = {at(4.005, noisier(loaded))};
  const test::RunRecorder with = run(loaded);
  ASSERT_EQ(with.acks.size(), 1U);
  EXPECT_EQ(with.acks[0].apply_time_ns, 4 * kSecond_ns + 5'000'000);
  EXPECT_EQ(with.acks[0].first_sequence, 201U);
  EXPECT_EQ(with.acks[0].first_sample_time_ns, 4 * kSecond_ns + 40'000'000);
  EXPECT_EQ(first_difference(without.samples, with.samples), 201U);
  EXPECT_EQ(with.samples[200].revisions.imu_error, 0U);
  EXPECT_EQ(with.samples[201].revisions.imu_error, 1U);
}

TEST(OfflineRun, ASwapOfTheReceiverTakesEffectAtTheEpochAfterIt) {
  auto loaded = turning();
  const test::RunRecorder without = run(loaded);
  GnssErrorProfile worse = loaded.gnss.front().errors;
  worse.position_sigma_ned_m.setConstant(5.0);
  loaded.swaps = {at(4.0, worse)};
  const test::RunRecorder with = run(loaded);
  ASSERT_EQ(with.acks.size(), 1U);
  EXPECT_EQ(with.acks[0].first_sample_time_ns, 4 * kSecond_ns + 100'000'000);
  const std::size_t first = first_difference(without.fixes, with.fixes);
  ASSERT_LT(first, with.fixes.size());
  EXPECT_EQ(with.fixes[first].header.sim_time_ns, with.acks[0].first_sample_time_ns);
  EXPECT_EQ(with.fixes[first].header.sequence_number, with.acks[0].first_sequence);
  EXPECT_EQ(first_difference(without.samples, with.samples), without.samples.size());
}

TEST(OfflineRun, ARejectedSwapChangesNothingAndNamesTheField) {
  auto loaded = turning();
  const test::RunRecorder without = run(loaded);
  ImuErrorProfile broken = noisier(loaded);
  broken.gyro.bias_gm_correlation_time_s.y() = 0.0;
  loaded.swaps = {at(4.0, broken)};
  const test::RunRecorder with = run(loaded);
  ASSERT_EQ(with.acks.size(), 1U);
  EXPECT_EQ(with.acks[0].outcome, AckOutcome::Rejected);
  EXPECT_EQ(with.acks[0].field, "gyro.bias_gm_correlation_time_s[1]");
  EXPECT_TRUE(with.entries.empty());
  EXPECT_EQ(first_difference(without.samples, with.samples), without.samples.size());
}

TEST(OfflineRun, OfTwoSwapsOfOneInstantTheLaterWins) {
  auto loaded = turning();
  loaded.swaps = {at(4.0, noisier(loaded))};
  const test::RunRecorder alone = run(loaded);
  ImuErrorProfile superseded = noisier(loaded);
  superseded.name = "superseded";
  superseded.gyro.arw_deg_per_sqrt_h.setConstant(30.0);
  loaded.swaps = {at(4.0, superseded), at(4.0, noisier(loaded))};
  const test::RunRecorder both = run(loaded);
  ASSERT_EQ(both.acks.size(), 2U);
  EXPECT_EQ(both.acks[0].outcome, AckOutcome::Superseded);
  EXPECT_EQ(both.acks[1].outcome, AckOutcome::Applied);
  EXPECT_EQ(both.acks[1].first_sequence, 800U);
  EXPECT_EQ(first_difference(alone.samples, both.samples), alone.samples.size());
}

}  // namespace offline_run_test
}  // namespace inslab::sim
