#include "inslab/models/imu/bias.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::imu {
namespace bias_test {

constexpr std::uint64_t kSeed = 77;
constexpr double kDt = 0.005;

Bias made(const TriadParameters& parameters, std::uint64_t seed = kSeed, const char* triad = "imu0/gyro") {
  return {parameters, kDt, seed, triad};
}

TEST(Bias, ConstantAndJumpAddTheirIntegral) {
  TriadParameters parameters;
  parameters.bias_constant = {1.0, 2.0, 3.0};
  Bias bias = made(parameters);
  EXPECT_EQ(bias.error(0.0, 0), Vector3(1.0, 2.0, 3.0) * kDt);
  bias.set_jump({10.0, 0.0, 0.0});
  EXPECT_EQ(bias.error(0.0, 1), Vector3(11.0, 2.0, 3.0) * kDt);
  bias.set_jump(Vector3::Zero());
  EXPECT_EQ(bias.error(0.0, 2), Vector3(1.0, 2.0, 3.0) * kDt);
}

TEST(Bias, ChangesWithTheTemperature) {
  TriadParameters parameters;
  parameters.bias_per_deg_c = {0.5, 0.0, -1.0};
  EXPECT_EQ(made(parameters).error(10.0, 0), Vector3(5.0, 0.0, -10.0) * kDt);
}

TEST(Bias, TurnOnStaysForTheRunAndDiffersFromRunToRun) {
  TriadParameters parameters;
  parameters.bias_turn_on_sigma.setConstant(1.0);
  Bias bias = made(parameters);
  const Vector3 first = bias.error(0.0, 0);
  EXPECT_EQ(bias.error(0.0, 1), first);
  EXPECT_NE(made(parameters, kSeed + 1).error(0.0, 0), first);
  EXPECT_NE(made(parameters, kSeed, "imu1/gyro").error(0.0, 0), first);
}

TEST(Bias, IsTheSumOfItsProcessesEachOnItsOwnStream) {
  TriadParameters parameters;
  parameters.bias_gm_sigma.setConstant(1.0);
  parameters.bias_gm_correlation_time_s.setConstant(100.0);
  parameters.bias_random_walk.setConstant(2.0);
  parameters.bias_instability.setConstant(3.0);
  Bias bias = made(parameters);
  random::GaussMarkov gauss_markov({1.0, 100.0}, kDt, random::Stream(kSeed, "imu0/gyro.z/bias_gm"));
  random::RandomWalk walk(2.0, kDt, random::Stream(kSeed, "imu0/gyro.z/bias_random_walk"));
  random::Flicker flicker(3.0, kDt, random::Stream(kSeed, "imu0/gyro.z/bias_instability"));
  for (std::uint64_t k = 0; k < 100; ++k) {
    const double sum = gauss_markov.value() + walk.value() + flicker.value();
    EXPECT_DOUBLE_EQ(bias.error(0.0, k).z(), sum * kDt);
    gauss_markov.advance(k);
    walk.advance(k);
    flicker.advance(k);
  }
}

TriadParameters random_bias(double sigma) {
  TriadParameters parameters;
  parameters.bias_turn_on_sigma.setConstant(sigma);
  parameters.bias_gm_sigma.setConstant(sigma);
  parameters.bias_gm_correlation_time_s.setConstant(1000.0);
  parameters.bias_random_walk.setConstant(sigma);
  parameters.bias_instability.setConstant(sigma);
  return parameters;
}

TEST(Bias, KeepScalesTheStatesWithTheirSigma) {
  Bias kept = made(random_bias(1.0)), swapped = kept;
  for (std::uint64_t k = 0; k < 10; ++k) EXPECT_EQ(kept.error(0.0, k), swapped.error(0.0, k));
  swapped.retune(random_bias(3.0), Continuity::Keep, 10);
  EXPECT_TRUE(swapped.error(0.0, 10).isApprox(3.0 * kept.error(0.0, 10), 1e-14));
}

TEST(Bias, ResetLeavesTheTurnOnValueAlone) {
  Bias bias = made(random_bias(1.0));
  TriadParameters turn_on_only;
  turn_on_only.bias_turn_on_sigma.setConstant(1.0);
  Bias turn_on = made(turn_on_only);
  for (std::uint64_t k = 0; k < 5; ++k) bias.error(0.0, k);
  bias.retune(random_bias(1.0), Continuity::Reset, 5);
  EXPECT_EQ(bias.error(0.0, 5), turn_on.error(0.0, 5));
}

TEST(Bias, RedrawDrawsEveryStateAnewAndAlwaysTheSame) {
  Bias a = made(random_bias(1.0)), b = a, before = a;
  a.retune(random_bias(1.0), Continuity::Redraw, 5);
  b.retune(random_bias(1.0), Continuity::Redraw, 5);
  const Vector3 redrawn = a.error(0.0, 5);
  EXPECT_EQ(redrawn, b.error(0.0, 5));
  EXPECT_GT((redrawn - before.error(0.0, 5)).cwiseAbs().minCoeff(), 0.0);
}

}  // namespace bias_test
}  // namespace inslab::imu
