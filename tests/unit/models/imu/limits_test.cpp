#include <gtest/gtest.h>

#include <cmath>

#include "inslab/models/imu/dropped_samples.hpp"
#include "inslab/models/imu/triad_limits.hpp"

namespace inslab::imu {
namespace limits_test {

constexpr double kDt = 0.01;

TEST(Saturation, CutsTheMeanRateAtFullScaleAndSaysSo) {
  TriadParameters parameters;
  parameters.full_scale = {100.0, 100.0, 0.0};
  const Saturation saturation(parameters, kDt);
  const Saturation::Result cut = saturation.limited({-1.5, 0.5, 77.0});
  EXPECT_EQ(cut.increment, Vector3(-1.0, 0.5, 77.0));
  EXPECT_TRUE(cut.saturated);
  EXPECT_FALSE(saturation.limited({1.0, -1.0, 77.0}).saturated);
}

TEST(Quantization, PutsOutWholeCounts) {
  TriadParameters parameters;
  parameters.quantization = {0.25, 0.5, 0.0};
  Quantization quantization(parameters);
  EXPECT_EQ(quantization.quantized({0.9, -0.9, 0.123}), Vector3(1.0, -1.0, 0.123));
}

TEST(Quantization, CarriesTheRemainderSoThatNothingIsLost) {
  TriadParameters parameters;
  parameters.quantization.setConstant(0.1);
  Quantization quantization(parameters);
  Vector3 in = Vector3::Zero(), out = Vector3::Zero();
  for (int k = 0; k < 10000; ++k) {
    const Vector3 x(0.003, 0.37 * std::sin(k), -0.0499);
    in += x;
    out += quantization.quantized(x);
    ASSERT_LE((out - in).cwiseAbs().maxCoeff(), 0.05 + 1e-9) << k;  // half a count, and 1e4 roundings of 500
  }
}

TEST(Quantization, ASwapToAnotherCountKeepsTheRemainder) {
  TriadParameters coarse, fine;
  coarse.quantization.setConstant(1.0);
  fine.quantization.setConstant(0.25);
  Quantization quantization(coarse);
  EXPECT_EQ(quantization.quantized({0.25, 0.25, 0.25}), Vector3::Zero());
  quantization.retune(fine);
  EXPECT_EQ(quantization.quantized({0.25, 0.0, 0.0}), Vector3(0.5, 0.25, 0.25));
}

TEST(Quantization, ACountBelowTheResolutionOfTheIncrementChangesNothing) {
  TriadParameters parameters;
  parameters.quantization.setConstant(1e-310);
  Quantization quantization(parameters);
  EXPECT_EQ(quantization.quantized({0.9, -1e-3, 0.0}), Vector3(0.9, -1e-3, 0.0));
}

TEST(AxisFaults, StuckRepeatsTheLastIncrementBeforeTheFault) {
  faults::AxisFaults faults;
  faults.applied({1.0, 2.0, 3.0});
  faults.set({AxisFault::None, AxisFault::Stuck, AxisFault::None});
  EXPECT_EQ(faults.applied({4.0, 5.0, 6.0}), Vector3(4.0, 2.0, 6.0));
  EXPECT_EQ(faults.applied({7.0, 8.0, 9.0}), Vector3(7.0, 2.0, 9.0));
  faults.set({});
  EXPECT_EQ(faults.applied({7.0, 8.0, 9.0}), Vector3(7.0, 8.0, 9.0));
}

TEST(AxisFaults, SignFlipAndNanTouchTheirAxisAlone) {
  faults::AxisFaults faults;
  faults.set({AxisFault::SignFlip, AxisFault::None, AxisFault::Nan});
  const Vector3 out = faults.applied({1.0, 2.0, 3.0});
  EXPECT_EQ(out.head<2>(), Eigen::Vector2d(-1.0, 2.0));
  EXPECT_TRUE(std::isnan(out.z()));
}

TEST(TriadLimits, ASilentSensorGivesNothingAndIsNotValid) {
  TriadLimits limits(TriadParameters(), kDt);
  limits.set_faults({}, true);
  const TriadLimits::Result out = limits.applied({1.0, 2.0, 3.0}, false);
  EXPECT_EQ(out.increment, Vector3::Zero());
  EXPECT_FALSE(out.valid);
}

TEST(TriadLimits, ADroppedSampleLosesItsIncrementAndNoOther) {
  TriadParameters parameters;
  parameters.quantization.setConstant(1.0);
  TriadLimits limits(parameters, kDt), undisturbed = limits;
  const Vector3 x(0.6, 0.6, 0.6);
  EXPECT_FALSE(limits.applied(x, true).valid);
  undisturbed.applied(x, false);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(limits.applied(x, false).increment, undisturbed.applied(x, false).increment);
}

TEST(TriadLimits, FilterComesBeforeSaturationAndThatBeforeCounts) {
  TriadParameters parameters;
  parameters.bandwidth_hz.setConstant(1.0);
  parameters.full_scale.setConstant(100.0);
  parameters.quantization.setConstant(0.3);
  TriadLimits limits(parameters, kDt);
  limits.applied(Vector3::Zero(), false);
  // A spike of twice full scale for one interval: a first-order filter of 1 Hz lets 3 % of it through.
  const TriadLimits::Result spike = limits.applied({2.0, 0.0, 0.0}, false);
  EXPECT_FALSE(spike.saturated);
  TriadLimits settled(parameters, kDt);
  const TriadLimits::Result steady = settled.applied({2.0, 0.0, 0.0}, false);
  EXPECT_TRUE(steady.saturated);
  EXPECT_DOUBLE_EQ(steady.increment.x(), 0.9);  // 3 counts of 0.3 in a full scale of 1
}

TEST(DroppedSamples, ComeAtTheirProbabilityAndAlwaysTheSame) {
  // 20000 draws at p: the share has the standard error sqrt(p (1 - p)/n).
  constexpr double kP = 0.05;
  const DroppedSamples drops(kP, random::Stream(5, "imu0/dropped_samples"));
  int count = 0;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    count += drops.dropped(k) ? 1 : 0;
    EXPECT_EQ(drops.dropped(k), drops.dropped(k));
  }
  EXPECT_NEAR(count / 20000.0, kP, 4.0 * std::sqrt(kP * (1.0 - kP) / 20000.0));
}

TEST(DroppedSamples, NoneWithoutAProbability) {
  const DroppedSamples drops(0.0, random::Stream(5, "imu0/dropped_samples"));
  for (std::uint64_t k = 0; k < 100; ++k) EXPECT_FALSE(drops.dropped(k));
}

}  // namespace limits_test
}  // namespace inslab::imu
