#include "inslab/models/imu/triad_delay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

/// One triad feels what it puts out later than the other: the integral over a shifted window.
namespace inslab::imu {
namespace triad_delay_test {

const nav::Gravity kGravity;
constexpr std::int64_t kTruthNs = 1000000;

ImuModel::Setup late(double accel_delay_s, double rate_hz) {
  ImuModel::Setup setup{42, 0, time::Rate(rate_hz), kGravity, {}, {}, {}};
  setup.errors.accel_delay_s = accel_delay_s;
  return setup;
}

std::vector<ImuModel::Output> run(ImuModel model, const std::vector<TruthState>& truth) {
  std::vector<ImuModel::Output> outputs;
  for (const TruthState& t : truth) {
    if (auto output = model.measure(t)) outputs.push_back(*output);
  }
  return outputs;
}

/// Force along x and rate about y, each a sin(w t + 0.3).
constexpr double kW = 2.0 * units::kPi * 1.5;
double wave(double t) { return std::sin(kW * t + 0.3); }
double wave_integral(double from, double to) { return (std::cos(kW * from + 0.3) - std::cos(kW * to + 0.3)) / kW; }

std::vector<TruthState> waves(std::int64_t samples) {
  std::vector<TruthState> truth;
  for (std::int64_t k = 0; k < samples; ++k) {
    TruthState state;
    const double t = time::to_seconds(k * kTruthNs), before = time::to_seconds((k - 1) * kTruthNs);
    state.header.sim_time_ns = k * kTruthNs;
    state.f_v.x() = state.omega_iv_v.y() = wave(t);
    if (k > 0) {
      state.interval_ns = kTruthNs;
      state.dv_v.x() = state.dtheta_v.y() = wave_integral(before, t);
    }
    truth.push_back(state);
  }
  return truth;
}

const std::vector<TruthState>& tumbling() {
  static const std::vector<TruthState> truth = [] {
    std::vector<TruthState> samples;
    for (std::int64_t k = 0; k < 601; ++k) samples.push_back(test::AnalyticMotion().truth(k, kTruthNs, kGravity));
    return samples;
  }();
  return truth;
}

TEST(TriadDelay, ASinusoidComesWithThePhaseOfTheDelay) {
  // The windows end within intervals of the truth; the cubic that a quadratic leaves out: w^3 h^4 / 72 = 1.2e-11.
  for (const double delay_s : {0.0033, 0.005, -0.0004, -0.0047}) {
    const auto outputs = run(ImuModel(late(delay_s, 100.0)), waves(1001));
    for (std::size_t k = 2; k < outputs.size(); ++k) {
      const double to = 0.01 * static_cast<double>(k + 1), from = to - 0.01;
      const double accel = std::max(delay_s, 0.0), gyro = std::max(-delay_s, 0.0);
      EXPECT_NEAR(outputs[k].sample.dv_b.x(), wave_integral(from - accel, to - accel), 2e-11) << delay_s << ' ' << k;
      EXPECT_NEAR(outputs[k].sample.dtheta_b.y(), wave_integral(from - gyro, to - gyro), 2e-11) << delay_s << ' ' << k;
      EXPECT_EQ(outputs[k].truth.accel_error.delay, outputs[k].sample.dv_b - outputs[k].truth.dv_b);
      EXPECT_NEAR(outputs[k].truth.dv_b.x(), wave_integral(from, to), 1e-15);
    }
  }
}

TEST(TriadDelay, WindowsFollowEachOtherWithoutAGap) {
  // Of the waves at 5 ms before: the sum telescopes to the rounding of 100 terms of 1e-2.
  const auto outputs = run(ImuModel(late(0.0033, 100.0)), waves(1001));
  double sum = 0.0;
  for (std::size_t k = 1; k < outputs.size(); ++k) sum += outputs[k].sample.dv_b.x();
  EXPECT_NEAR(sum, wave_integral(0.01 - 0.0033, 1.0 - 0.0033), 3e-11);
}

TEST(TriadDelay, AtTheStartTheTriadFeltWhatItBeganWith) {
  const auto outputs = run(ImuModel(late(0.004, 1000.0)), waves(20));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(outputs[k].sample.dv_b.x(), 1e-3 * wave(0.0), 1e-15);
  EXPECT_NEAR(outputs[4].sample.dv_b.x(), wave_integral(0.0, 1e-3), 1e-15);
}

TEST(TriadDelay, AVibrationOfTheOutputComesLateBehindItsFilter) {
  for (const double delay_s : {0.0021, -0.0021}) {
    ImuModel::Setup setup = late(delay_s, 200.0);
    setup.errors.accel.bandwidth_hz.setConstant(20.0);
    setup.errors.gyro.bandwidth_hz.setConstant(20.0);
    setup.vibration.linear.push_back({Vector3(10.0, 0.0, 0.0), 190.0, Vector3(30.0, 0.0, 0.0)});
    setup.vibration.angular.push_back({Vector3(0.0, 10.0, 0.0), 190.0, Vector3(0.0, 30.0, 0.0)});
    ImuModel model(setup);
    const double w = 2.0 * units::kPi * 190.0, x = 0.5 * w * 5e-3;
    const std::complex<double> gain = 10.0 / std::complex<double>(1.0, 190.0 / 20.0) * 5e-3 * std::sin(x) / x;
    for (std::int64_t k = 0; k <= 100; ++k) {
      TruthState still;
      still.header.sim_time_ns = k * 5000000;
      still.interval_ns = k == 0 ? 0 : 5000000;
      const auto output = model.measure(still);
      if (k == 0) continue;
      const double middle = (static_cast<double>(k) - 0.5) * 5e-3;
      const auto seen = [&](double late_s) {
        return (gain * std::polar(1.0, w * (middle - late_s) + 30.0 * units::kDeg)).imag();
      };
      EXPECT_NEAR(output->sample.dv_b.x(), seen(std::max(delay_s, 0.0)), 1e-12) << k;
      EXPECT_NEAR(output->sample.dtheta_b.y(), seen(std::max(-delay_s, 0.0)) * units::kDeg, 1e-12) << k;
    }
  }
}

/// Everything that the motion goes through before the triad's errors.
ImuModel::Setup wide(double accel_delay_s, double rate_hz) {
  ImuModel::Setup setup = late(accel_delay_s, rate_hz);
  setup.errors.accel_place_m << 0.02, 0.01, 0.0, -0.01, 0.03, 0.0, 0.0, 0.02, -0.02;
  setup.installation.lever_arm_v_m = {0.8, -0.5, 1.5};
  setup.installation.mounting_rpy_deg = {1.0, 2.0, 90.0};
  return setup;
}

VibrationProfile shaken_mount() {
  VibrationProfile profile;
  profile.domain = VibrationDomain::Motion;
  profile.linear.push_back({Vector3(1.0, 2.0, 3.0), 27.0, Vector3::Zero()});
  profile.angular.push_back({Vector3(15.0, 5.0, 5.0), 27.0, Vector3::Zero()});
  return profile;
}

TEST(TriadDelay, ByWholeIntervalsIsTheSampleOfThatManyIntervalsBefore) {
  // With a filter what the start left has decayed after 100 intervals: exp(-0.1 * 2 pi 300) is 1e-82.
  for (const bool moves : {false, true}) {
    for (const double bandwidth_hz : {0.0, 300.0}) {
      ImuModel::Setup now = wide(0.0, 1000.0), then = wide(0.003, 1000.0), gyros = wide(-0.003, 1000.0);
      for (ImuModel::Setup* setup : {&now, &then, &gyros}) {
        setup->errors.accel.bandwidth_hz.setConstant(bandwidth_hz);
        setup->errors.gyro.bandwidth_hz.setConstant(bandwidth_hz);
        if (moves) setup->vibration = shaken_mount();
      }
      const auto a = run(ImuModel(now), tumbling()), b = run(ImuModel(then), tumbling());
      const auto c = run(ImuModel(gyros), tumbling());
      for (std::size_t k = 100; k < a.size(); ++k) {
        EXPECT_LT((b[k].sample.dv_b - a[k - 3].sample.dv_b).norm(), 1e-15) << moves << ' ' << bandwidth_hz;
        EXPECT_LT((c[k].sample.dtheta_b - a[k - 3].sample.dtheta_b).norm(), 1e-16) << moves << ' ' << bandwidth_hz;
        EXPECT_LT((b[k].sample.dtheta_b - a[k].sample.dtheta_b).norm(), 1e-18);
        EXPECT_EQ(c[k].sample.dv_b, a[k].sample.dv_b);
        EXPECT_LT((b[k].truth.accel_error.sum() - (b[k].sample.dv_b - b[k].truth.dv_b)).norm(), 1e-16);
      }
    }
  }
}

TEST(TriadDelay, OfASlowImuIsCutOutOfTheIntervalsOfTheTruth) {
  // 2.5 ms of a 200 Hz IMU: half intervals of a 1000 Hz truth, which a mount at rest and a moving one cut at their
  // ends.
  for (const bool moves : {false, true}) {
    ImuModel::Setup slow = wide(0.0025, 200.0), fast = wide(0.0, 2000.0);
    if (moves) slow.vibration = fast.vibration = shaken_mount();
    std::vector<TruthState> fine;
    for (std::int64_t k = 0; k < 401; ++k) fine.push_back(test::AnalyticMotion().truth(k, kTruthNs / 2, kGravity));
    const auto outputs = run(ImuModel(slow), tumbling()), parts = run(ImuModel(fast), fine);
    for (std::size_t k = 1; k < 40; ++k) {
      Vector3 dv = Vector3::Zero();
      for (std::size_t i = 0; i < 10; ++i) dv += parts[10 * k + i - 5].sample.dv_b;
      // The truth's quadratics leave f''' h^4 / 72 of the motion and 1e-8 of the mount's force of 4 m/s^2 over 0.5 ms.
      EXPECT_LT((outputs[k].sample.dv_b - dv).norm(), 2e-11) << moves << ' ' << k;
    }
  }
}

TEST(TriadDelay, SwapsForAnotherOfTheMotionThatWasFelt) {
  ImuModel model(late(0.002, 1000.0));
  const auto truth = waves(100);
  for (int k = 0; k < 100; ++k) {
    if (k == 50) model.apply(late(0.0045, 1000.0).errors);
    if (k == 75) model.apply(late(-0.001, 1000.0).errors);
    const auto output = model.measure(truth[static_cast<std::size_t>(k)]);
    if (k < 10) continue;
    const double to = 1e-3 * k - (k < 50 ? 0.002 : k < 75 ? 0.0045 : 0.0);
    EXPECT_NEAR(output->sample.dv_b.x(), wave_integral(to - 1e-3, to), 1e-11) << k;
  }
}

TEST(TriadDelay, BeginsAfreshWhereTheImuIsRelocatedTo) {
  ImuModel::Setup setup = late(0.003, 1000.0);
  ImuModel model(setup), there([&] {
    ImuModel::Setup moved = setup;
    moved.installation.mounting_rpy_deg = {0.0, 0.0, 90.0};
    return moved;
  }());
  const auto truth = waves(40);
  for (int k = 0; k < 40; ++k) {
    if (k == 20) {
      InstallationProfile moved;
      moved.mounting_rpy_deg = {0.0, 0.0, 90.0};
      model.apply(moved);
    }
    const auto output = model.measure(truth[static_cast<std::size_t>(k)]);
    const auto expected = there.measure(truth[static_cast<std::size_t>(k)]);
    if (k >= 20 && k < 23) {
      EXPECT_NEAR(output->sample.dv_b.y(), -1e-3 * wave(0.019), 1e-9) << k;
    }
    if (k >= 23) {
      EXPECT_EQ(output->sample.dv_b, expected->sample.dv_b) << k;
    }
  }
}

}  // namespace triad_delay_test
}  // namespace inslab::imu
