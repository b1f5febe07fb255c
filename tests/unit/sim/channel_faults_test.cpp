// Faults of single measured values, of every kind of sensor and every value that the catalogue has of it, and what the
// truth of an IMU says of faults.

#include <cmath>
#include <map>

#include "tests/unit/sim/fault_bench.hpp"

namespace inslab::sim {
namespace channel_faults_test {

using namespace fault_bench;

TEST(ChannelFaults, AValueIsFlippedJumpsAndDriftsByItself) {
  for_every_kind([](auto kind) {
    using Kind = typename decltype(kind)::type;
    const auto by_number = channels_by_number(Kind::kind);
    for (const catalog::MeasuredChannel& channel : catalog::measured_channels(Kind::kind)) {
      SCOPED_TRACE(channel.name);
      const double range = channel.most_shown - channel.least_shown;
      CommonFaults faults;
      faults.channels = {{std::string(channel.name), true, Vector3::Constant(0.125 * range),
                          Vector3::Constant(-0.0625 * range), Vector3::Zero()}};
      const Bench<Kind> bench(faults);
      bench.expect_no_trace();
      const auto all = Bench<Kind>::by_time(bench.with);
      for (const auto& [time_ns, right] : Bench<Kind>::by_time(bench.without)) {
        if (!is_on(time_ns)) continue;
        const double elapsed_s = 1e-9 * static_cast<double>(time_ns - kOn_ns);
        const std::vector<double> good = measured(right), shown = measured(all.at(time_ns));
        for (std::size_t i = 0; i < good.size(); ++i) {
          const double expected =
              by_number[i].name == channel.name ? -good[i] + range * (0.125 - 0.0625 * elapsed_s) : good[i];
          ASSERT_NEAR(shown[i], expected, 1e-12 * range) << by_number[i].name << " at " << time_ns;
        }
      }
    }
  });
}

/// The mean square of n draws is within five standard errors, sigma^2 sqrt(2/n), of sigma^2; nothing else changes.
TEST(ChannelFaults, ANoiseBurstHasItsSigmaOnThatValueAlone) {
  for_every_kind([](auto kind) {
    using Kind = typename decltype(kind)::type;
    const auto by_number = channels_by_number(Kind::kind);
    for (const catalog::MeasuredChannel& channel : catalog::measured_channels(Kind::kind)) {
      SCOPED_TRACE(channel.name);
      const double sigma = 0.01 * (channel.most_shown - channel.least_shown);
      CommonFaults faults;
      faults.channels = {
          {std::string(channel.name), false, Vector3::Zero(), Vector3::Zero(), Vector3::Constant(sigma)}};
      const Bench<Kind> bench(faults);
      bench.expect_no_trace();
      const auto all = Bench<Kind>::by_time(bench.with);
      std::vector<double> squares(by_number.size(), 0.0);
      double n = 0.0;
      for (const auto& [time_ns, right] : Bench<Kind>::by_time(bench.without)) {
        if (!is_on(time_ns)) continue;
        const std::vector<double> good = measured(right), shown = measured(all.at(time_ns));
        for (std::size_t i = 0; i < good.size(); ++i) squares[i] += std::pow((shown[i] - good[i]) / sigma, 2);
        n += 1.0;
      }
      for (std::size_t i = 0; i < squares.size(); ++i) {
        if (by_number[i].name == channel.name) {
          EXPECT_NEAR(squares[i] / n, 1.0, 5.0 * std::sqrt(2.0 / n));
        } else {
          EXPECT_EQ(squares[i], 0.0) << by_number[i].name;
        }
      }
    }
  });
}

/// Increments follow from the rates, counts and distance from the speed, the pressure altitude from the pressure.
TEST(ChannelFaults, WhatFollowsFromAMeasuredValueChangesWithIt) {
  CommonFaults faults;
  faults.channels = {{"mean_f_b_m_per_s2", false, Vector3(0.0, 2.0, 0.0), Vector3::Zero(), Vector3::Zero()}};
  const Bench<catalog::Imu> imu(faults);
  faults.channels = {{"speed_m_per_s", false, Vector3::Constant(1.5), Vector3::Zero(), Vector3::Zero()}};
  const Bench<catalog::Odometer> odometer(faults);
  faults.channels = {{"pressure_pa", false, Vector3::Constant(-1200.0), Vector3::Zero(), Vector3::Zero()}};
  const Bench<catalog::Barometer> barometer(faults);
  for (std::size_t i = 0; i < imu.with.size(); ++i) {
    const double jump = is_on(imu.with[i].at_ns) ? 0.005 * 2.0 : 0.0;
    const Vector3 more = imu.with[i].sample.dv_b - imu.without[i].sample.dv_b;
    ASSERT_LT((more - Vector3(0.0, jump, 0.0)).norm(), 1e-15);
    ASSERT_EQ(imu.with[i].sample.dtheta_b, imu.without[i].sample.dtheta_b);
  }
  for (std::size_t i = 0; i < odometer.with.size(); ++i) {
    const WheelTravel &shown = odometer.with[i].sample, &right = odometer.without[i].sample;
    const double jump = is_on(shown.header.sim_time_ns) ? 0.01 * 1.5 : 0.0;
    ASSERT_NEAR(shown.distance_m - right.distance_m, jump, 1e-15);
    if (right.counts == 0) continue;
    const double one_m = right.distance_m / static_cast<double>(right.counts);
    ASSERT_NEAR(static_cast<double>(shown.counts - right.counts), jump / one_m, 0.5 + 1e-9);
  }
  for (std::size_t i = 0; i < barometer.with.size(); ++i) {
    const AirPressure &shown = barometer.with[i].sample, &right = barometer.without[i].sample;
    // Near the ground a hectopascal less is 8.4 m more: dH = -dp R T / (g p), here between 8.3 and 9.5 m.
    const double more_m = shown.pressure_altitude_m - right.pressure_altitude_m;
    if (is_on(shown.header.sim_time_ns)) {
      ASSERT_GT(more_m, 12 * 8.3);
      ASSERT_LT(more_m, 12 * 9.5);
    } else {
      ASSERT_EQ(more_m, 0.0);
    }
  }
}

/// The truth beside each sample says what acted on it; that its budget has it is checked of every fault by the bench.
TEST(ChannelFaults, TheTruthOfAnImuSaysWhichFaultsActed) {
  const EveryKind& run = EveryKind::run();
  Sensor<catalog::Imu> sensor(run.scenario, run.scenario.imus.front());
  FaultProfile profile;
  profile.request.apply_at_ns = kOn_ns;
  profile.request.journal_number = 1;
  profile.common.stuck = true;
  profile.common.rate_divisor = 2;
  sensor.add(profile);
  for (const TruthState& truth : run.truth) {
    const auto result = sensor.process(truth);
    if (!result.output) continue;
    const std::int64_t time_ns = result.output->sample.header.sim_time_ns;
    const bool is_left_out = (time_ns / 5'000'000) % 2 != 0;
    const std::uint32_t expected = time_ns <= kOn_ns ? 0u : is_left_out ? 0b10000010u : 0b10u;
    ASSERT_EQ(result.output->truth.active_faults, expected) << time_ns;
    ASSERT_TRUE(expected != 0 || result.output->truth.gyro_error.fault.isZero(0.0)) << time_ns;
  }
}

}  // namespace channel_faults_test
}  // namespace inslab::sim
