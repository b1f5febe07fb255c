#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "inslab/models/imu/imu_model.hpp"
#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/noise/allan/noise_model.hpp"

/// The random errors of the whole IMU model, read off its output by Allan variance: several seeds and three axes give
/// independent estimates, and the tolerance is 4 standard errors from their own spread. (With 48 estimates that is
/// exceeded by chance at 2e-4 a point.)
namespace inslab::statistical {
namespace imu_statistics_test {

using allan::allan_variance;
using allan::overlapped_allan_variance;

constexpr std::uint64_t kSeeds = 8;

/// What a perfect vehicle that does not even feel the Earth says: all output is error.
TruthState nothing(std::int64_t k, std::int64_t period_ns) {
  TruthState truth;
  truth.header.sim_time_ns = k * period_ns;
  truth.interval_ns = k == 0 ? 0 : period_ns;
  return truth;
}

/// Integrated output of the three gyros (0..2, rad) and accelerometers (3..5, m/s).
std::array<std::vector<double>, 6> integrated_output(const ImuErrorProfile& errors, std::uint64_t seed, double rate_hz,
                                                     std::int64_t samples) {
  imu::ImuModel model({seed, 0, time::Rate(rate_hz), nav::Gravity(), errors, {}, {}});
  const std::int64_t period_ns = time::Rate(rate_hz).period().count();
  std::array<std::vector<double>, 6> angle;
  for (auto& axis : angle) axis.assign(1, 0.0);
  for (std::int64_t k = 0; k <= samples; ++k) {
    const auto output = model.measure(nothing(k, period_ns));
    if (!output) continue;
    for (int axis = 0; axis < 3; ++axis) {
      angle[axis].push_back(angle[axis].back() + output->sample.dtheta_b[axis]);
      angle[3 + axis].push_back(angle[3 + axis].back() + output->sample.dv_b[axis]);
    }
  }
  return angle;
}

struct Estimate {
  double mean;
  double standard_error;
};

Estimate pooled(const std::vector<double>& values) {
  double sum = 0.0, square = 0.0;
  for (const double v : values) sum += v;
  const auto count = static_cast<double>(values.size());
  const double mean = sum / count;
  for (const double v : values) square += (v - mean) * (v - mean);
  return {mean, std::sqrt(square / (count - 1.0) / count)};
}

// Thesis tables 4-4 and 4-5: 20 minutes at 200 Hz; the Allan variance of white noise of density N is N^2/tau.
TEST(ImuStatistics, RandomWalksComeBackFromTheAllanVariance) {
  const double arw[3] = {0.002, 0.1, 3.0};     // deg/sqrt(h)
  const double vrw[3] = {0.0008, 0.03, 0.12};  // m/s/sqrt(h)
  ImuErrorProfile errors;
  errors.gyro.arw_deg_per_sqrt_h = {arw[0], arw[1], arw[2]};
  errors.accel.vrw_m_per_s_per_sqrt_h = {vrw[0], vrw[1], vrw[2]};
  const std::array<std::int64_t, 4> windows{1, 10, 200, 2000};
  std::array<std::array<std::vector<double>, 4>, 6> ratios;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto angle = integrated_output(errors, seed, 200.0, 240000);
    for (int axis = 0; axis < 6; ++axis) {
      const double density = axis < 3 ? arw[axis] * units::kDegPerSqrtH : vrw[axis - 3] * units::kMPerSPerSqrtH;
      for (std::size_t w = 0; w < windows.size(); ++w) {
        const double tau_s = static_cast<double>(windows[w]) * 0.005;
        ratios[axis][w].push_back(overlapped_allan_variance(angle[axis], 0.005, windows[w]).variance * tau_s /
                                  (density * density));
      }
    }
  }
  for (std::size_t w = 0; w < windows.size(); ++w) {
    std::vector<double> all;
    for (const auto& axis : ratios) all.insert(all.end(), axis[w].begin(), axis[w].end());
    const Estimate estimate = pooled(all);
    EXPECT_NEAR(estimate.mean, 1.0, 4.0 * estimate.standard_error) << windows[w];
    EXPECT_LT(estimate.standard_error, 0.05) << windows[w];
  }
}

// Thesis tables 4-6 and 4-7, low grade 2: sigma 36 deg/h and 1000 mGal, T = 10 s, here 2 h at 10 Hz.
TEST(ImuStatistics, GaussMarkovBiasFollowsTheAllanVarianceOfAHeldProcess) {
  ImuErrorProfile errors;
  errors.gyro.bias_gm_sigma_deg_per_h.setConstant(36.0);
  errors.gyro.bias_gm_correlation_time_s.setConstant(10.0);
  errors.accel.bias_gm_sigma_mgal.setConstant(1000.0);
  errors.accel.bias_gm_correlation_time_s.setConstant(10.0);
  for (const std::int64_t window : {1, 10, 100, 189, 1000}) {
    std::vector<double> ratios;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const auto angle = integrated_output(errors, seed, 10.0, 72000);
      for (int axis = 0; axis < 6; ++axis) {
        const double sigma = axis < 3 ? 36.0 * units::kDegPerH : 1000.0 * units::kMGal;
        allan::NoiseModel held;
        held.gm_sigma = sigma;
        held.gm_correlation_time_s = 10.0;
        ratios.push_back(overlapped_allan_variance(angle[axis], 0.1, window).variance /
                         allan_variance(held, 0.1, window));
      }
    }
    const Estimate estimate = pooled(ratios);
    EXPECT_NEAR(estimate.mean, 1.0, 4.0 * estimate.standard_error) << window;
    EXPECT_LT(estimate.standard_error, 0.05) << window;
  }
}

TEST(ImuStatistics, TurnOnBiasesSpreadOverRunsAsTheirSigma) {
  // 3 axes x 500 seeds: the sample variance of N draws has relative standard error sqrt(2/N) = 3.7 %.
  ImuErrorProfile errors;
  errors.gyro.bias_turn_on_sigma_deg_per_h.setConstant(100.0);
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const auto angle = integrated_output(errors, seed, 1.0, 1);
    for (int axis = 0; axis < 3; ++axis) sum += angle[axis].back() * angle[axis].back();
  }
  const double expected = std::pow(100.0 * units::kDegPerH, 2);
  EXPECT_NEAR(sum / 1500.0, expected, 4.0 * std::sqrt(2.0 / 1500.0) * expected);
}

}  // namespace imu_statistics_test
}  // namespace inslab::statistical
