#include <gtest/gtest.h>

#include "inslab/referee/score/verdict.hpp"
#include "inslab/sim/offline_run.hpp"

/// The scorer's true pose of an IMU is the one that the IMU's own model publishes.
namespace inslab::score {
namespace scored_truth_test {

/// Scores the perfect answers of one IMU, over turns and over a swap of its installation.
class PerfectAnswers : public sim::RunSink {
 public:
  PerfectAnswers(const scenario::LoadedScenario& loaded, std::uint32_t imu_number)
      : imu_number_(imu_number), scorer_(loaded.scenario, options_for(imu_number)) {
    for (const auto& imu : loaded.imus) scorer_.add(imu.installation, -1);
  }

  void journal(const catalog::AnyProfile& entry) override {
    if (const auto* moved = std::get_if<InstallationProfile>(&entry)) scorer_.add(*moved, moved->request.apply_at_ns);
  }
  void truth(const TruthState& truth) override { scorer_.add(truth); }
  void imu(std::size_t, const ImuSample& sample, const ImuTruth& truth) override {
    if (sample.sensor_number != imu_number_) return;
    NavSolution solution;
    solution.gps_week = truth.header.gps_week;
    solution.gps_time_of_week_ns = truth.header.gps_time_of_week_ns;
    solution.reference_point = ReferencePoint::Imu;
    solution.mode = NavMode::Navigating;
    solution.latitude_rad = truth.latitude_rad;
    solution.longitude_rad = truth.longitude_rad;
    solution.height_m = truth.height_m;
    solution.v_n = truth.v_n;
    solution.q_n_body = truth.q_nb;
    scorer_.add(solution, 0);
  }
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}

  const Scorer& finished() {
    scorer_.finish();
    return scorer_;
  }

 private:
  static Scorer::Options options_for(std::uint32_t imu_number) {
    Scorer::Options options;
    options.imu_number = imu_number;
    return options;
  }

  std::uint32_t imu_number_;
  Scorer scorer_;
};

// 16 s: 3200 samples at 200 Hz and 1600 at 100 Hz. Positions to the rounding of their angles, 1e-9 m.
TEST(TrueImu, IsWhereTheScorerTakesItToBeThroughTurnsAndASwapOfItsInstallation) {
  const auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/two_imus_two_antennas.json");
  for (const std::uint32_t number : {0U, 1U}) {
    PerfectAnswers answers(loaded, number);
    sim::OfflineRun run(loaded, {2446, 36000'000'000'000}, RunId{}, answers);
    while (run.step()) {
    }
    const Scorer& scorer = answers.finished();
    ASSERT_EQ(scorer.counts().scored, number == 0 ? 3200U : 1600U);
    const ErrorStatistics& all = scorer.phases().at({});
    EXPECT_LT(all.position().largest.norm(), 5e-9);
    EXPECT_LT(all.velocity().largest.norm(), 1e-9);
    EXPECT_LT(all.phi().largest.norm(), 1e-12);
  }
}

}  // namespace scored_truth_test
}  // namespace inslab::score
