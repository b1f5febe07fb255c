// Rates whose periods are no whole number of nanoseconds, and sensors whose rates do not divide the truth's.

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/sim/offline_run.hpp"
#include "tests/unit/sim/run_recorder.hpp"

namespace inslab::sim {
namespace odd_rates_test {

struct Rates {
  double truth_hz;
  double imu_hz;
  double gnss_hz;
};

const Rates kRates[] = {{200.0, 1024.0, 10.0}, {120.0, 120.0, 4.0}, {1000.0, 300.0, 8.0},     {150.0, 60.0, 7.0},
                        {600.0, 3000.0, 1.0},  {29.97, 30.0, 0.3},  {100.0 / 3.0, 99.99, 5.0}};

/// A vehicle that speeds up and turns about one axis for `duration_s`, an IMU and a receiver without errors.
scenario::LoadedScenario turning(const Rates& rates, double duration_s = 10.0) {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.name = "turning";
  s.seed = 7;
  s.duration_s = duration_s;
  s.trajectory.initial.latitude_deg = 30.0;
  s.trajectory.initial.speed_m_per_s = 10.0;
  scenario::Motion turn, faster;
  turn.type = scenario::MotionType::Turn;
  turn.angle_deg = 90.0;
  faster.type = scenario::MotionType::DeltaSpeed;
  faster.speed_change_m_per_s = 5.0;
  s.trajectory.segments.push_back({"turn", 10.0, {turn, faster}, true});
  loaded.truth_rate = time::Rate(rates.truth_hz);
  scenario::LoadedImu imu;
  imu.rate = time::Rate(rates.imu_hz);
  loaded.imus.push_back(imu);
  scenario::LoadedGnss gnss;
  gnss.rate = time::Rate(rates.gnss_hz);
  gnss.installation.target = gnss.nominal_installation.target = {SensorKind::Gnss, 0};
  gnss.errors.position_sigma_ned_m.setConstant(0.5);
  gnss.errors.velocity_sigma_ned_m_per_s.setConstant(0.05);
  loaded.gnss.push_back(gnss);
  loaded.truth_samples = 1 + loaded.truth_grid().index(time::from_seconds(duration_s));
  return loaded;
}

test::RunRecorder run(const scenario::LoadedScenario& loaded) {
  test::RunRecorder recorder;
  OfflineRun offline(loaded, {2400, 0}, RunId{}, recorder);
  while (offline.step()) {
  }
  return recorder;
}

TEST(OddRates, EverySampleLiesAtItsInstantAndIntervalsMeet) {
  for (const Rates& rates : kRates) {
    const auto loaded = turning(rates);
    const test::RunRecorder all = run(loaded);
    const time::Rate imu(rates.imu_hz), gnss(rates.gnss_hz);
    ASSERT_EQ(all.truths.size(), loaded.truth_samples) << rates.imu_hz;
    for (std::size_t k = 1; k < all.truths.size(); ++k) {
      const TruthState& truth = all.truths[k];
      ASSERT_EQ(truth.header.sequence_number, k);
      ASSERT_EQ(truth.header.sim_time_ns, loaded.truth_grid().at(k).count()) << rates.truth_hz;
      ASSERT_EQ(truth.interval_ns, truth.header.sim_time_ns - all.truths[k - 1].header.sim_time_ns);
    }
    ASSERT_EQ(all.samples.size(), imu.index(std::chrono::seconds(10))) << rates.imu_hz;
    for (std::size_t k = 0; k < all.samples.size(); ++k) {
      const ImuSample& sample = all.samples[k];
      ASSERT_EQ(sample.header.sequence_number, k);
      ASSERT_EQ(sample.header.sim_time_ns, imu.at(k + 1).count()) << rates.imu_hz;
      ASSERT_EQ(sample.interval_ns, (imu.at(k + 1) - imu.at(k)).count()) << rates.imu_hz;
      ASSERT_EQ(all.imu_truths[k].interval_ns, sample.interval_ns);
    }
    ASSERT_EQ(all.fixes.size(), gnss.index(std::chrono::seconds(10))) << rates.gnss_hz;
    for (std::size_t k = 0; k < all.fixes.size(); ++k) {
      ASSERT_EQ(all.fixes[k].header.sim_time_ns, gnss.at(k + 1).count()) << rates.gnss_hz;
    }
  }
}

TEST(OddRates, IncrementsAreTheSameIntegralsAsAtAWholeRate) {
  // Sums over 1 s, which every rate here that is whole in Hz has instants at; each second's turn and speed to rounding.
  const test::RunRecorder whole = run(turning({1000.0, 1000.0, 1.0}));
  for (const Rates& rates : kRates) {
    if (rates.imu_hz != std::floor(rates.imu_hz)) continue;
    const test::RunRecorder odd = run(turning(rates));
    const auto per_second = static_cast<std::size_t>(rates.imu_hz);
    for (std::size_t second = 0; second < 10; ++second) {
      Vector3 odd_dtheta = Vector3::Zero(), odd_dv = Vector3::Zero(), dtheta = odd_dtheta, dv = odd_dv;
      for (std::size_t k = 0; k < 1000; ++k) {
        dtheta += whole.samples[1000 * second + k].dtheta_b;
        dv += whole.samples[1000 * second + k].dv_b;
      }
      for (std::size_t k = 0; k < per_second; ++k) {
        odd_dtheta += odd.samples[per_second * second + k].dtheta_b;
        odd_dv += odd.samples[per_second * second + k].dv_b;
      }
      EXPECT_LT((odd_dtheta - dtheta).norm(), 1e-12) << rates.imu_hz << " Hz, second " << second;
      EXPECT_LT((odd_dv - dv).norm(), 2e-10) << rates.imu_hz << " Hz, second " << second;
    }
  }
}

/// At rest each interval's increments are the constant specific force times its own length: an interval taken a
/// nanosecond too long errs by 3e-7 of it at 300 Hz.
TEST(OddRates, AConstantForceGivesTheSameMeanInLongAndShortIntervals) {
  auto loaded = turning({200.0, 300.0, 4.0});
  loaded.scenario.trajectory.initial.speed_m_per_s = 0.0;
  loaded.scenario.trajectory.segments.clear();
  loaded.imus[0].errors.accel.bias_constant_mgal.setConstant(100.0);
  const test::RunRecorder all = run(loaded);
  const ImuSample& first = all.samples.front();
  std::int64_t shortest_ns = first.interval_ns, longest_ns = first.interval_ns;
  for (const ImuSample& sample : all.samples) {
    shortest_ns = std::min(shortest_ns, sample.interval_ns);
    longest_ns = std::max(longest_ns, sample.interval_ns);
    const double dt_s = time::to_seconds(sample.interval_ns);
    ASSERT_LT((sample.dv_b / dt_s - first.mean_f_b).norm(), 1e-12 * first.mean_f_b.norm());
    ASSERT_LT((sample.mean_f_b - first.mean_f_b).norm(), 1e-12 * first.mean_f_b.norm());
  }
  EXPECT_EQ(longest_ns - shortest_ns, 1);
  for (const ImuTruth& truth : all.imu_truths) {
    ASSERT_DOUBLE_EQ(truth.accel_error.bias.x(), 100e-5 * static_cast<double>(truth.interval_ns) * 1e-9);
  }
}

/// A filter at its input and a cut at full scale see mean rates, so neither turns a nanosecond into noise.
TEST(OddRates, BandwidthAndFullScaleTakeTheIntervalsOwnLength) {
  auto loaded = turning({200.0, 300.0, 4.0});
  loaded.scenario.trajectory.initial.speed_m_per_s = 0.0;
  loaded.scenario.trajectory.segments.clear();
  loaded.imus[0].errors.accel.bandwidth_hz.setConstant(50.0);
  loaded.imus[0].errors.accel.full_scale_g = Vector3(20.0, 20.0, 1.2);
  loaded.imus[0].errors.accel.bias_constant_mgal = Vector3(0.0, 0.0, -400e3);  // 0.4 g upwards: 1.4 g in all
  const test::RunRecorder all = run(loaded);
  for (const ImuSample& sample : all.samples) {
    ASSERT_TRUE(sample.accel_saturated);
    ASSERT_NEAR(sample.mean_f_b.z(), -1.2 * 9.80665, 1e-11);
    ASSERT_LT(std::abs(sample.mean_f_b.x() - all.samples.front().mean_f_b.x()), 1e-12);
  }
}

TEST(OddRates, ADayEndsAtADayAndItsIncrementsSumToItsMotion) {
  // 0.7 and 0.3 Hz, so that a day is short: 1428571428.571 and 3333333333.333 ns.
  constexpr double kDay_s = 86'400.0;
  auto loaded = turning({1.0, 0.7, 0.3}, kDay_s);
  loaded.scenario.trajectory.initial.speed_m_per_s = 0.0;
  loaded.scenario.trajectory.segments.clear();
  const test::RunRecorder all = run(loaded);
  EXPECT_EQ(all.truths.back().header.sim_time_ns, 86'400'000'000'000);
  ASSERT_EQ(all.samples.size(), 60'480u);
  EXPECT_EQ(all.samples.back().header.sim_time_ns, 86'400'000'000'000);
  ASSERT_EQ(all.fixes.size(), 25'920u);
  EXPECT_EQ(all.fixes.back().header.sim_time_ns, 86'400'000'000'000);
  // At rest the vehicle turns with the Earth, about a constant axis in its own frame.
  Vector3 angle = Vector3::Zero();
  std::int64_t time_ns = 0;
  for (const ImuSample& sample : all.samples) {
    angle += sample.dtheta_b;
    time_ns += sample.interval_ns;
  }
  EXPECT_EQ(time_ns, 86'400'000'000'000);
  constexpr double kEarth_rad_per_s = 7.292115e-5;
  // 3e-13 of it is rounding: 6e4 sums up to 6 rad. Periods rounded to nanoseconds would be off by 2e-9 rad at the end.
  EXPECT_NEAR(angle.norm(), kEarth_rad_per_s * kDay_s, 1e-11);
}

}  // namespace odd_rates_test
}  // namespace inslab::sim
