#include "services/imu_error_injector/triad_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::imu {
namespace {

constexpr std::uint64_t kSeed = 77;
constexpr double kDt = 0.005;

TriadErrors triad(const TriadParameters& parameters, std::uint64_t seed = kSeed) {
  return {parameters, kDt, seed, "imu0/gyro", "arw"};
}

TEST(TriadParameters, UnitsOfDataSheetsBecomeSi) {
  GyroErrors gyro;
  gyro.bias_constant_deg_per_h.setConstant(3600.0);
  gyro.arw_deg_per_sqrt_h.setConstant(60.0);
  gyro.scale_factor_ppm.setConstant(1e6);
  gyro.cross_axis_arcsec.setConstant(3600.0);
  const TriadParameters si = in_si(gyro);
  const double deg = 3.14159265358979323846 / 180.0;
  EXPECT_DOUBLE_EQ(si.bias_constant.x(), deg);
  EXPECT_DOUBLE_EQ(si.random_walk.y(), deg);
  EXPECT_DOUBLE_EQ(si.scale_factor.z(), 1.0);
  EXPECT_DOUBLE_EQ(si.cross_axis_rad[5], deg);
  AccelErrors accel;
  accel.bias_gm_sigma_mgal.setConstant(1e5);
  accel.vrw_m_per_s_per_sqrt_h.setConstant(60.0);
  EXPECT_DOUBLE_EQ(in_si(accel).bias_gm_sigma.x(), 1.0);
  EXPECT_DOUBLE_EQ(in_si(accel).random_walk.x(), 1.0);
}

TEST(ScaleFactor, MultipliesEachAxisByItsOwn) {
  EXPECT_EQ(ScaleFactor({0.5, -0.25, 0.0}).error({2.0, 4.0, 8.0}), Vector3(1.0, -1.0, 0.0));
}

TEST(CrossAxis, AnAngleXToYShowsTheInputOfXOnTheOutputOfY) {
  Vector6 angles;
  angles << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // x to y, x to z, y to x, y to z, z to x, z to y
  const CrossAxis cross_axis(angles);
  EXPECT_EQ(cross_axis.error({1.0, 0.0, 0.0}), Vector3(0.0, 1.0, 2.0));
  EXPECT_EQ(cross_axis.error({0.0, 1.0, 0.0}), Vector3(3.0, 0.0, 4.0));
  EXPECT_EQ(cross_axis.error({0.0, 0.0, 1.0}), Vector3(5.0, 6.0, 0.0));
}

TEST(Bias, ConstantAndJumpAddTheirIntegral) {
  TriadParameters parameters;
  parameters.bias_constant = {1.0, 2.0, 3.0};
  Bias bias(parameters, kDt, kSeed, "imu0/gyro");
  EXPECT_EQ(bias.error(0), Vector3(1.0, 2.0, 3.0) * kDt);
  bias.set_jump({10.0, 0.0, 0.0});
  EXPECT_EQ(bias.error(1), Vector3(11.0, 2.0, 3.0) * kDt);
  bias.set_jump(Vector3::Zero());
  EXPECT_EQ(bias.error(2), Vector3(1.0, 2.0, 3.0) * kDt);
}

TEST(Bias, TurnOnStaysForTheRunAndDiffersFromRunToRun) {
  TriadParameters parameters;
  parameters.bias_turn_on_sigma.setConstant(1.0);
  Bias bias(parameters, kDt, kSeed, "imu0/gyro");
  const Vector3 first = bias.error(0);
  EXPECT_EQ(bias.error(1), first);
  EXPECT_NE(Bias(parameters, kDt, kSeed + 1, "imu0/gyro").error(0), first);
  EXPECT_NE(Bias(parameters, kDt, kSeed, "imu1/gyro").error(0), first);
}

TriadParameters random_bias(double sigma) {
  TriadParameters parameters;
  parameters.bias_turn_on_sigma.setConstant(sigma);
  parameters.bias_gm_sigma.setConstant(sigma);
  parameters.bias_gm_correlation_time_s.setConstant(1000.0);
  return parameters;
}

TEST(Bias, KeepScalesTheStatesWithTheirSigma) {
  Bias kept(random_bias(1.0), kDt, kSeed, "imu0/gyro"), swapped = kept;
  for (std::uint64_t k = 0; k < 10; ++k) EXPECT_EQ(kept.error(k), swapped.error(k));
  swapped.retune(random_bias(3.0), Continuity::Keep, 10);
  EXPECT_TRUE(swapped.error(10).isApprox(3.0 * kept.error(10), 1e-14));
}

TEST(Bias, ResetLeavesTheTurnOnValueAlone) {
  Bias bias(random_bias(1.0), kDt, kSeed, "imu0/gyro");
  TriadParameters turn_on_only = random_bias(1.0);
  turn_on_only.bias_gm_sigma.setZero();
  Bias turn_on(turn_on_only, kDt, kSeed, "imu0/gyro");
  bias.error(0);
  bias.retune(random_bias(1.0), Continuity::Reset, 1);
  EXPECT_EQ(bias.error(1), turn_on.error(1));
}

TEST(Bias, RedrawDrawsEveryStateAnewAndAlwaysTheSame) {
  Bias a(random_bias(1.0), kDt, kSeed, "imu0/gyro"), b = a, before = a;
  a.retune(random_bias(1.0), Continuity::Redraw, 5);
  b.retune(random_bias(1.0), Continuity::Redraw, 5);
  const Vector3 redrawn = a.error(5);
  EXPECT_EQ(redrawn, b.error(5));
  EXPECT_TRUE((redrawn - before.error(5)).cwiseAbs().minCoeff() > 0.0);
}

TEST(TriadErrors, ScaleAndCrossAxisActOnTruthAndVibrationTogether) {
  TriadParameters parameters;
  parameters.scale_factor.setConstant(0.1);
  parameters.cross_axis_rad[0] = 0.01;
  TriadErrors errors = triad(parameters);
  const TriadErrorBudget budget = errors.errors({1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0);
  EXPECT_DOUBLE_EQ(budget.scale.x(), 0.2);
  EXPECT_DOUBLE_EQ(budget.cross_axis.y(), 0.02);
  EXPECT_EQ(budget.vibration, Vector3(1.0, 0.0, 0.0));
  EXPECT_EQ(budget.noise, Vector3::Zero());
  EXPECT_EQ(budget.bias, Vector3::Zero());
}

TEST(TriadErrors, ChangingOneTermLeavesTheDrawsOfTheOthersAlone) {
  TriadParameters noise_only;
  noise_only.random_walk.setConstant(1e-3);
  TriadParameters both = random_bias(1.0);
  both.random_walk = noise_only.random_walk;
  TriadErrors a = triad(noise_only), b = triad(both);
  for (std::uint64_t k = 0; k < 20; ++k) {
    EXPECT_EQ(a.errors(Vector3::Zero(), Vector3::Zero(), k).noise, b.errors(Vector3::Zero(), Vector3::Zero(), k).noise);
  }
}

}  // namespace
}  // namespace inslab::imu
