#include "inslab/models/imu/scale_factor.hpp"

#include <gtest/gtest.h>

namespace inslab::imu {
namespace scale_factor_test {

constexpr double kDt = 0.005;
const Vector3 kOnes = Vector3::Ones();

ScaleFactor made(const TriadParameters& parameters, std::uint64_t seed = 77) {
  return {parameters, kDt, seed, "imu0/gyro"};
}

TEST(ScaleFactor, MultipliesEachAxisByItsOwn) {
  TriadParameters parameters;
  parameters.scale_factor = {0.5, -0.25, 0.0};
  EXPECT_EQ(made(parameters).error({2.0, 4.0, 8.0}, 0.0, 0), Vector3(1.0, -1.0, 0.0));
}

TEST(ScaleFactor, ChangesWithTheTemperature) {
  TriadParameters parameters;
  parameters.scale_factor_per_deg_c = {0.25, 0.0, -0.5};
  EXPECT_EQ(made(parameters).error(kOnes, 8.0, 0), Vector3(2.0, 0.0, -4.0));
}

TEST(ScaleFactor, TurnOnStaysForTheRunAndDiffersFromRunToRun) {
  TriadParameters parameters;
  parameters.scale_factor_turn_on_sigma.setConstant(1e-3);
  ScaleFactor scale_factor = made(parameters);
  const Vector3 first = scale_factor.error(kOnes, 0.0, 0);
  EXPECT_EQ(scale_factor.error(kOnes, 0.0, 1), first);
  EXPECT_NE(made(parameters, 78).error(kOnes, 0.0, 0), first);
}

TriadParameters wandering(double sigma) {
  TriadParameters parameters;
  parameters.scale_factor_turn_on_sigma.setConstant(sigma);
  parameters.scale_factor_gm_sigma.setConstant(sigma);
  parameters.scale_factor_gm_correlation_time_s.setConstant(100.0);
  return parameters;
}

TEST(ScaleFactor, IsTheGaussMarkovProcessOfItsStream) {
  TriadParameters parameters = wandering(1e-3);
  parameters.scale_factor_turn_on_sigma.setZero();
  ScaleFactor scale_factor = made(parameters);
  random::GaussMarkov process({1e-3, 100.0}, kDt, random::Stream(77, "imu0/gyro.y/scale_factor_gm"));
  for (std::uint64_t k = 0; k < 50; ++k) {
    EXPECT_EQ(scale_factor.error({0.0, 2.0, 0.0}, 0.0, k).y(), 2.0 * process.value());
    process.advance(k);
  }
}

TEST(ScaleFactor, KeepScalesTheStatesWithTheirSigma) {
  ScaleFactor kept = made(wandering(1e-3)), swapped = kept;
  swapped.retune(wandering(3e-3), Continuity::Keep, 10);
  EXPECT_TRUE(swapped.error(kOnes, 0.0, 10).isApprox(3.0 * kept.error(kOnes, 0.0, 10), 1e-14));
}

TEST(ScaleFactor, ResetLeavesTheTurnOnValueAloneAndRedrawDrawsBothAnew) {
  TriadParameters turn_on_only = wandering(1e-3);
  turn_on_only.scale_factor_gm_sigma.setZero();
  ScaleFactor reset = made(wandering(1e-3)), redrawn = reset, turn_on = made(turn_on_only);
  reset.retune(wandering(1e-3), Continuity::Reset, 1);
  redrawn.retune(wandering(1e-3), Continuity::Redraw, 1);
  const Vector3 constant = turn_on.error(kOnes, 0.0, 1);
  EXPECT_EQ(reset.error(kOnes, 0.0, 1), constant);
  EXPECT_GT((redrawn.error(kOnes, 0.0, 1) - constant).cwiseAbs().minCoeff(), 0.0);
}

}  // namespace scale_factor_test
}  // namespace inslab::imu
