#include <gtest/gtest.h>

#include "tests/unit/sim/run_recorder.hpp"

/// A recording that is swapped in while a run goes on.
namespace inslab::sim {
namespace grafted_run_test {

scenario::LoadedScenario grafting() {
  return scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/grafting.json");
}

test::RunRecorder run(const scenario::LoadedScenario& loaded) {
  test::RunRecorder recorder;
  OfflineRun offline(loaded, {2446, 36000'000'000'000}, RunId{}, recorder);
  while (offline.step()) {
  }
  return recorder;
}

TEST(GraftedRun, HasTheRecordingsErrorsBetweenItsSwapsAndTheProfilesOutsideThem) {
  const scenario::LoadedScenario loaded = grafting();
  scenario::LoadedScenario plain = loaded;
  plain.swaps.clear();
  const test::RunRecorder with = run(loaded), without = run(plain);
  ASSERT_EQ(with.samples.size(), without.samples.size());
  ASSERT_EQ(with.acks.size(), 2u);
  for (const ProfileAck& ack : with.acks) EXPECT_EQ(ack.outcome, AckOutcome::Applied);
  const auto& recorded = std::get<ImuErrorProfile>(loaded.swaps[0]).recorded_error;
  const auto recording = loaded.recordings(recorded.file, recorded.sha256);
  for (std::size_t k = 0; k < with.samples.size(); ++k) {
    const std::int64_t ns = with.samples[k].header.sim_time_ns;
    const TriadErrorBudget& gyro = with.imu_truths[k].gyro_error;
    if (ns <= 25'000'000'000) {
      EXPECT_EQ(with.samples[k].dtheta_b, without.samples[k].dtheta_b) << ns;
      continue;
    }
    if (ns > 55'000'000'000) {
      EXPECT_EQ(gyro.recorded, Vector3::Zero());
      EXPECT_EQ(gyro.noise, without.imu_truths[k].gyro_error.noise) << ns;
      continue;
    }
    EXPECT_EQ(with.samples[k].dtheta_b, with.imu_truths[k].dtheta_b + gyro.recorded);
    EXPECT_NE(gyro.recorded, Vector3::Zero());
    EXPECT_EQ(gyro.noise, Vector3::Zero());
  }
}

TEST(GraftedRun, RejectsARecordingThatTheFolderDoesNotHaveAndGoesOn) {
  const scenario::LoadedScenario loaded = grafting();
  TruthSource source(loaded, loaded.start(time::Nanoseconds(0)), RunId());
  source.take();
  ImuErrorProfile request = std::get<ImuErrorProfile>(loaded.swaps[0]);
  request.recorded_error.file = "none.mcap";
  request.recorded_error.sha256 = std::string(64, '1');
  const auto answer = source.submit(request);
  ASSERT_TRUE(std::holds_alternative<ProfileAck>(answer));
  const auto& ack = std::get<ProfileAck>(answer);
  EXPECT_EQ(ack.outcome, AckOutcome::Rejected);
  EXPECT_NE(ack.reason.find("none.mcap: is not there"), std::string::npos) << ack.reason;
  EXPECT_TRUE(source.has_next());
  EXPECT_TRUE(std::holds_alternative<catalog::AnyProfile>(source.submit(loaded.swaps[0])));
}

}  // namespace grafted_run_test
}  // namespace inslab::sim
