#include "inslab/models/imu/random_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/vibration.hpp"

namespace inslab::imu {
namespace random_vibration_test {

constexpr double kDt = 0.005;

/// 10 to 70 Hz with a slope, and a plateau above half of the sample rate's 200 Hz, on x; another level on y; none on z.
std::vector<LinearRandomPoint> table() {
  return {{10.0, {0.1, 1.0, 0.0}},
          {30.0, {0.4, 1.0, 0.0}},
          {70.0, {0.4, 1.0, 0.0}},
          {130.0, {0.2, 1.0, 0.0}},
          {190.0, {0.2, 1.0, 0.0}}};
}

RandomVibration made() { return {Spectrum(table()), kDt, 42, "imu0/vibration/accel"}; }

/// What the integral over dt makes of the table at a frequency below 100 Hz: of mean rates, one-sided.
double folded(int axis, double frequency_hz) {
  const Spectrum spectrum(table());
  const auto seen = [&](double f) {
    const double x = units::kPi * f * kDt;
    return spectrum.density(axis, f) * std::pow(std::sin(x) / x, 2);
  };
  return seen(frequency_hz) + seen(200.0 - frequency_hz) + seen(200.0 + frequency_hz);
}

TEST(Spectrum, IsAStraightLineOfLogarithmsBetweenCornersAndNothingOutside) {
  const Spectrum spectrum(std::vector<LinearRandomPoint>{{10.0, {1.0, 0.0, 4.0}}, {1000.0, {100.0, 8.0, 4.0}}});
  EXPECT_DOUBLE_EQ(spectrum.density(0, 100.0), 10.0);
  EXPECT_DOUBLE_EQ(spectrum.density(1, 505.0), 4.0);  // from 0: no logarithm
  EXPECT_DOUBLE_EQ(spectrum.density(2, 20.0), 4.0);
  EXPECT_EQ(spectrum.density(0, 9.9), 0.0);
  EXPECT_EQ(spectrum.density(0, 1000.1), 0.0);
}

TEST(RandomVibration, TheMeasuredDensityIsTheTablesWithinItsChiSquareBand) {
  // 128 segments of 512 samples under a Hann window. A band of m bins averages 128 m values of two degrees of freedom,
  // neighbours correlated 4/9 and 1/36 in power: relative standard error sqrt(1.944 / (128 m)). Bands keep 2 Hz off the
  // corners, which the filter rounds over a step of 1/(256 dt) = 0.8 Hz and the window over as much.
  constexpr int kSegment = 512, kSegments = 128;
  RandomVibration vibration = made();
  std::array<std::vector<double>, 2> power{std::vector<double>(kSegment / 2), std::vector<double>(kSegment / 2)};
  Eigen::FFT<double> fft;
  std::uint64_t k = 0;
  for (int s = 0; s < kSegments; ++s) {
    std::array<std::vector<std::complex<double>>, 2> samples;
    for (int i = 0; i < kSegment; ++i) {
      const Vector3 rate = vibration.increment(k++) / kDt;
      const double hann = 0.5 - 0.5 * std::cos(2.0 * units::kPi * i / kSegment);
      for (int axis = 0; axis < 2; ++axis) samples[axis].emplace_back(hann * rate[axis]);
      EXPECT_EQ(rate.z(), 0.0);
    }
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<std::complex<double>> spectrum;
      fft.fwd(spectrum, samples[axis]);
      // One-sided: 2 dt |X|^2 over the window's sum of squares, 3/8 of the length.
      for (int i = 0; i < kSegment / 2; ++i) {
        power[axis][i] += 2.0 * kDt * std::norm(spectrum[i]) / (0.375 * kSegment) / kSegments;
      }
    }
  }
  const std::pair<double, double> bands[] = {{12.0, 28.0}, {32.0, 50.0}, {50.0, 68.0}, {72.0, 98.0}};
  for (int axis = 0; axis < 2; ++axis) {
    for (const auto& [low_hz, high_hz] : bands) {
      double measured = 0.0, expected = 0.0, bins = 0.0;
      for (int i = 0; i < kSegment / 2; ++i) {
        const double frequency_hz = i / (kSegment * kDt);
        if (frequency_hz < low_hz || frequency_hz > high_hz) continue;
        measured += power[axis][i];
        expected += folded(axis, frequency_hz);
        bins += 1.0;
      }
      EXPECT_NEAR(measured / expected, 1.0, 4.0 * std::sqrt(1.944 / (kSegments * bins))) << axis << ' ' << low_hz;
    }
  }
}

TEST(RandomVibration, TheFilterRealisesTheFoldedTable) {
  // Away from corners a step of 0.8 Hz changes a log-log slope of at most 1.3 by its second difference, 1e-3 at 12 Hz.
  const RandomVibration vibration = made();
  for (const double frequency_hz : {15.0, 25.0, 40.0, 60.0, 80.0, 95.0}) {
    EXPECT_NEAR(vibration.realised_density(0, frequency_hz), folded(0, frequency_hz), 5e-3 * folded(0, frequency_hz))
        << frequency_hz;
  }
  EXPECT_LT(vibration.realised_density(0, 5.0), 1e-4 * folded(0, 15.0));
}

TEST(RandomVibration, EveryIntervalIsAPureFunctionOfItsNumber) {
  RandomVibration in_order = made(), at_once = made();
  std::vector<Vector3> increments;
  for (std::uint64_t k = 0; k < 1000; ++k) increments.push_back(in_order.increment(k));
  for (const std::uint64_t k : {999UL, 3UL, 500UL, 501UL, 0UL}) EXPECT_EQ(at_once.increment(k), increments[k]) << k;
}

TEST(RandomVibration, AxesAreIndependent) {
  // Of white noise with these spectra 4000 values are worth at least 1000 independent ones: 4/sqrt(1000).
  RandomVibration vibration = made();
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    const Vector3 v = vibration.increment(k);
    xy += v.x() * v.y();
    xx += v.x() * v.x();
    yy += v.y() * v.y();
  }
  EXPECT_LT(std::abs(xy) / std::sqrt(xx * yy), 4.0 / std::sqrt(1000.0));
}

TEST(RandomVibration, FadesInSmoothly) {
  VibrationProfile shaken;
  shaken.linear_random = table();
  Vibration vibration(VibrationProfile(), {kDt, 42, "imu0"}), full(shaken, {kDt, 42, "imu0"});
  constexpr std::int64_t kNs = 5000000;
  vibration.swap(shaken, 0, 1.0);
  for (std::int64_t k = 0; k < 300; ++k) {
    const double tau = (static_cast<double>(k) + 0.5) * kDt;
    const double weight = tau < 1.0 ? 0.5 - 0.5 * std::cos(units::kPi * tau) : 1.0;
    const Vector3 expected = weight * full.increments(k * kNs, (k + 1) * kNs).dv;
    EXPECT_LT((vibration.increments(k * kNs, (k + 1) * kNs).dv - expected).norm(), 1e-15) << k;  // increments of 0.03
  }
}

}  // namespace random_vibration_test
}  // namespace inslab::imu
