// Rates whose period is a whole number of nanoseconds give the samples that they gave when there were no others.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/sim/run_recorder.hpp"

namespace inslab::sim {
namespace whole_rates_test {

/// Of the last samples but one of ten seconds, and of the last fix.
struct Golden {
  int rate_hz;
  std::array<double, 3> truth;  ///< latitude_rad, v_n.y, dv_v.y
  std::array<double, 3> imu;    ///< dtheta_b.z, dv_b.y, mean_omega_ib_b.x
  std::array<double, 3> gnss;   ///< latitude_rad, height_m, v_n.x
};

/// A vehicle that turns, an IMU as fast as the truth and a receiver, with noise on all.
scenario::LoadedScenario turning(int rate_hz) {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.trajectory.gravity.model = nav::GravityModel::Somigliana;
  s.name = "turning";
  s.seed = 7;
  s.duration_s = 10.0;
  s.trajectory.initial.latitude_deg = 30.0;
  s.trajectory.initial.speed_m_per_s = 10.0;
  scenario::Motion turn;
  turn.type = scenario::MotionType::Turn;
  turn.angle_deg = 90.0;
  s.trajectory.segments.push_back({"turn", 10.0, {turn}, true});
  loaded.truth_rate = time::Rate(rate_hz);
  loaded.truth_samples = 10 * static_cast<std::uint64_t>(rate_hz) + 1;
  scenario::LoadedImu imu;
  imu.rate = time::Rate(rate_hz);
  imu.errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  imu.errors.gyro.bias_gm_sigma_deg_per_h.setConstant(10.0);
  imu.errors.gyro.bias_gm_correlation_time_s.setConstant(100.0);
  imu.errors.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.05);
  loaded.imus.push_back(imu);
  scenario::LoadedGnss gnss;
  gnss.rate = time::Rate(5.0);
  gnss.installation.target = gnss.nominal_installation.target = {SensorKind::Gnss, 0};
  gnss.errors.position_sigma_ned_m.setConstant(0.5);
  gnss.errors.velocity_sigma_ned_m_per_s.setConstant(0.05);
  loaded.gnss.push_back(gnss);
  return loaded;
}

/// Another libm may round a last digit the other way; an interval that is longer by a nanosecond, or another draw, is
/// 1e-7 of the value or more.
void expect_golden(double value, double golden, const char* what) {
  EXPECT_NEAR(value, golden, 1e-12 * std::max(1e-3, std::abs(golden))) << what;
}

class WholeRates : public testing::TestWithParam<Golden> {};

TEST_P(WholeRates, GiveTheSamplesThatTheyGaveBeforeThereWereOthers) {
  const Golden& golden = GetParam();
  test::RunRecorder all;
  OfflineRun run(turning(golden.rate_hz), {2446, 0}, RunId{}, all);
  while (run.step()) continue;
  ASSERT_EQ(all.truths.size(), 10U * golden.rate_hz + 1U);
  ASSERT_EQ(all.samples.size(), 10U * golden.rate_hz);
  const std::int64_t period_ns = 1'000'000'000 / golden.rate_hz;
  for (std::size_t k = 1; k < all.truths.size(); ++k) {
    ASSERT_EQ(all.truths[k].header.sim_time_ns, static_cast<std::int64_t>(k) * period_ns);
    ASSERT_EQ(all.truths[k].interval_ns, period_ns);
    ASSERT_EQ(all.samples[k - 1].header.sim_time_ns, static_cast<std::int64_t>(k) * period_ns);
    ASSERT_EQ(all.samples[k - 1].interval_ns, period_ns);
  }
  const TruthState& truth = all.truths[all.truths.size() - 2];
  expect_golden(truth.latitude_rad, golden.truth[0], "truth latitude");
  expect_golden(truth.v_n.y(), golden.truth[1], "truth v_n.y");
  expect_golden(truth.dv_v.y(), golden.truth[2], "truth dv_v.y");
  const ImuSample& sample = all.samples[all.samples.size() - 2];
  expect_golden(sample.dtheta_b.z(), golden.imu[0], "dtheta_b.z");
  expect_golden(sample.dv_b.y(), golden.imu[1], "dv_b.y");
  expect_golden(sample.mean_omega_ib_b.x(), golden.imu[2], "mean_omega_ib_b.x");
  const GnssFix& fix = all.fixes.back();
  expect_golden(fix.latitude_rad, golden.gnss[0], "fix latitude");
  expect_golden(fix.height_m, golden.gnss[1], "fix height");
  expect_golden(fix.v_n.x(), golden.gnss[2], "fix v_n.x");
}

// Taken from a build of before: hexadecimal, so nothing is rounded.
constexpr std::array<Golden, 8> kGolden{{
    {50,
     {0x1.0c16632d60d9fp-1, 0x1.3ffffffffffa6p+3, -0x1.2ea3d45007da2p-19},
     {0x1.ddebb71ca1ad2p-20, 0x1.1081b99666d39p-12, 0x1.4a10ed93ba15ap-12},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {100,
     {0x1.0c16632d60dabp-1, 0x1.3fffffffffffep+3, -0x1.867f5e8402p-18},
     {-0x1.7a8876c93114ap-24, -0x1.923178bac0b9p-14, -0x1.a5703f199fcd7p-13},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {125,
     {0x1.0c16632d60dabp-1, 0x1.4p+3, -0x1.569f57c8e8008p-18},
     {0x1.4dc929f3de38p-29, 0x1.689c264d561fap-17, 0x1.0db6a571a4705p-13},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {200,
     {0x1.0c16632d60dacp-1, 0x1.4p+3, -0x1.d534f8e50200bp-19},
     {-0x1.5812d5e4a9a52p-20, 0x1.e3f64e6e7d595p-15, 0x1.6deb7568c7e24p-14},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {250,
     {0x1.0c16632d60dacp-1, 0x1.4p+3, -0x1.7eebf08b68007p-19},
     {-0x1.af1d57cbb4e42p-20, 0x1.307dc4e034f4fp-15, -0x1.a7aac052482bfp-13},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {400,
     {0x1.0c16632d60dacp-1, 0x1.4p+3, -0x1.e8e25f770200bp-20},
     {-0x1.89dc3b5ab99b5p-19, 0x1.fdc55ad4c8e41p-16, -0x1.51df302ca82d1p-13},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
    {500,
     {0x1.0c16632d60dacp-1, 0x1.4000000000001p+3, -0x1.88ff16c06800bp-20},
     {0x1.1e2bc2a51e738p-22, -0x1.057c236a79b0ep-14, 0x1.34d29d994c8bbp-12},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccfb57p-5}},
    {1000,
     {0x1.0c16632d60dacp-1, 0x1.4000000000001p+3, -0x1.8b83e04268008p-21},
     {-0x1.e458806dccdb2p-23, -0x1.8fd4381ff2aaap-17, -0x1.c3b6f249928f2p-15},
     {0x1.0c16647533f6cp-1, 0x1.795208179b991p-2, -0x1.2375946ccf8d7p-5}},
}};

INSTANTIATE_TEST_SUITE_P(Hz, WholeRates, testing::ValuesIn(kGolden),
                         [](const auto& golden) { return std::to_string(golden.param.rate_hz); });

}  // namespace whole_rates_test
}  // namespace inslab::sim
