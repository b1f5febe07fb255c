#include "inslab/models/imu/thermal_bias.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"

/// Biases by how the temperature changes.
namespace inslab::imu {
namespace thermal_bias_test {

TriadParameters with_hysteresis(double height, double width_k) {
  TriadParameters parameters;
  parameters.bias_hysteresis.setConstant(height);
  parameters.bias_hysteresis_width_k = width_k;
  return parameters;
}

/// The mean bias while the temperature goes from `from` to `to` in steps of 0.1 K, at its end.
double bias_after(ThermalBias& bias, double from, double to) {
  const int steps = static_cast<int>(std::lround(std::abs(to - from) / 0.1));
  double last = 0.0;
  for (int i = 0; i < steps; ++i) {
    last = bias.error(from + (to - from) * i / steps, from + (to - from) * (i + 1) / steps, 0.5).x() / 0.5;
  }
  return last;
}

TEST(ThermalBias, ByTheRateAddsUpToTheCoefficientTimesTheChange) {
  // 3 deg/h per deg C/min over a rise of 7 deg C: 3 deg/h * 60 s/min * 7 = 1260 deg/h s, however long it takes.
  ImuErrorProfile profile;
  profile.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min.setConstant(3.0);
  for (const int steps : {1, 10}) {
    ThermalBias bias(gyros_in_si(profile));
    Vector3 sum = Vector3::Zero();
    for (int i = 0; i < steps; ++i) sum += bias.error(20.0 + 7.0 * i / steps, 20.0 + 7.0 * (i + 1) / steps, 0.1);
    EXPECT_NEAR(sum.y(), 1260.0 * units::kDegPerH, 1e-15);
  }
}

TEST(ThermalBias, HysteresisIsHalfItsHeightOnEitherBranchAndALineBetween) {
  // Height 8, width 4: up by 1 from the start is 8 * 1/4; beyond 2 it is 4, and turns down over 4 K to -4.
  ThermalBias bias(with_hysteresis(8.0, 4.0));
  EXPECT_NEAR(bias_after(bias, 20.0, 21.0), 2.0, 1e-12);
  EXPECT_NEAR(bias_after(bias, 21.0, 30.0), 4.0, 1e-12);
  EXPECT_NEAR(bias_after(bias, 30.0, 29.0), 2.0, 1e-12);
  EXPECT_NEAR(bias_after(bias, 29.0, 26.0), -4.0, 1e-12);
  EXPECT_NEAR(bias_after(bias, 26.0, 20.0), -4.0, 1e-12);
  EXPECT_NEAR(bias_after(bias, 20.0, 22.0), 0.0, 1e-12);
}

TEST(ThermalBias, TheLoopHasItsHeightAtEveryTemperatureWithin) {
  ThermalBias up(with_hysteresis(8.0, 4.0)), down(with_hysteresis(8.0, 4.0));
  bias_after(up, 0.0, 20.0);
  bias_after(down, 50.0, 30.0);
  EXPECT_NEAR(bias_after(up, 20.0, 25.0) - bias_after(down, 30.0, 25.0), 8.0, 1e-12);
}

TEST(ThermalBias, KeepsItsBranchAtASwapUnlessItIsReset) {
  ThermalBias kept(with_hysteresis(8.0, 4.0)), reset = kept;
  bias_after(kept, 20.0, 30.0);
  bias_after(reset, 20.0, 30.0);
  kept.retune(with_hysteresis(2.0, 4.0), Continuity::Keep);
  reset.retune(with_hysteresis(2.0, 4.0), Continuity::Reset);
  EXPECT_NEAR(kept.error(30.0, 30.0, 1.0).x(), 1.0, 1e-12);
  EXPECT_NEAR(reset.error(30.0, 30.0, 1.0).x(), 0.0, 1e-12);
}

TEST(ThermalBias, StandsInTheBudgetOfTheModel) {
  // 60 deg C in 1 s from 20 on: 1 deg C/s is 60 deg C/min.
  ImuModel::Setup setup{42, 0, time::Rate(100.0), nav::Gravity(), {}, {}, {}};
  setup.errors.temperature = {{0.0, 20.0}, {1.0, 21.0}};
  setup.errors.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min = {1.0, 2.0, 3.0};
  setup.errors.accel_bias_hysteresis_mgal.setConstant(100.0);
  setup.errors.bias_hysteresis_width_deg_c = 1.0;
  ImuModel model(setup);
  for (int k = 0; k <= 100; ++k) {
    TruthState truth;
    truth.header.sim_time_ns = k * 10000000;
    truth.interval_ns = k == 0 ? 0 : 10000000;
    const auto output = model.measure(truth);
    if (k == 0) continue;
    EXPECT_NEAR(output->sample.dtheta_b.z(), 180.0 * units::kDegPerH * 0.01, 1e-14);
    EXPECT_NEAR(output->truth.accel_error.bias.x(), std::min(k * 1.0, 50.0) * units::kMGal * 0.01, 1e-16);
  }
}

}  // namespace thermal_bias_test
}  // namespace inslab::imu
