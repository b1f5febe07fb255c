#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <unsupported/Eigen/FFT>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

/// A sensor's bandwidth acts in continuous time, and the interval's integral samples what it leaves.
namespace inslab::imu {
namespace bandwidth_response_test {

const nav::Gravity kGravity;

/// The vehicle feels `force` along x alone, whose integral from 0 is `velocity`.
struct Push {
  std::function<double(double)> force = [](double) { return 0.0; };
  std::function<double(double)> velocity = [](double) { return 0.0; };

  TruthState truth(std::int64_t k, std::int64_t period_ns) const {
    const auto t = [&](std::int64_t n) { return time::to_seconds(n * period_ns); };
    TruthState truth;
    truth.header.sim_time_ns = k * period_ns;
    truth.f_v.x() = force(t(k));
    if (k == 0) return truth;
    truth.interval_ns = period_ns;
    truth.dv_v.x() = velocity(t(k)) - velocity(t(k - 1));
    return truth;
  }
};

ImuModel::Setup filtered(double rate_hz, double bandwidth_hz, FilterOrder order) {
  ImuModel::Setup setup{42, 0, time::Rate(rate_hz), kGravity, {}, {}, {}};
  setup.errors.accel.bandwidth_hz.setConstant(bandwidth_hz);
  setup.errors.accel.bandwidth_order = order;
  setup.errors.gyro.bandwidth_hz.setConstant(bandwidth_hz);
  setup.errors.gyro.bandwidth_order = order;
  return setup;
}

VibrationProfile shaken(double amplitude, double frequency_hz, double phase_deg) {
  VibrationProfile profile;
  profile.linear.push_back({Vector3(amplitude, 0.0, 0.0), frequency_hz, Vector3(phase_deg, 0.0, 0.0)});
  profile.angular.push_back({Vector3(0.0, amplitude / units::kDeg, 0.0), frequency_hz, Vector3(0.0, phase_deg, 0.0)});
  return profile;
}

std::complex<double> response(double bandwidth_hz, FilterOrder order, double frequency_hz) {
  const double w = 2.0 * units::kPi * bandwidth_hz;
  const std::complex<double> p(0.0, 2.0 * units::kPi * frequency_hz);
  if (order == FilterOrder::First) return w / (w + p);
  return w * w / (w * w + std::sqrt(2.0) * w * p + p * p);
}

/// Amplitude at `seen_hz` of the mean force over `n` intervals of a 200 Hz IMU, a whole number of its periods.
double amplitude_seen(double vibration_hz, double bandwidth_hz, double seen_hz) {
  ImuModel::Setup setup = filtered(200.0, bandwidth_hz, FilterOrder::Second);
  setup.vibration = shaken(10.0, vibration_hz, 30.0);
  ImuModel model(setup);
  std::complex<double> sum = 0.0;
  for (std::int64_t k = 0; k <= 400; ++k) {
    const auto output = model.measure(Push().truth(k, 5000000));
    if (k <= 200) continue;
    sum +=
        output->sample.dv_b.x() / 5e-3 * std::polar(1.0, -2.0 * units::kPi * seen_hz * static_cast<double>(k) * 5e-3);
  }
  return 2.0 * std::abs(sum) / 200.0;
}

TEST(BandwidthResponse, AVibrationAboveHalfTheSampleRateIsFilteredBeforeItIsFolded) {
  // |H| sinc: (20/190)^2 * 0.0524 and 0.794 * 0.810, of 10 m/s^2.
  EXPECT_NEAR(amplitude_seen(190.0, 20.0, 10.0), 0.0058, 5e-5);
  EXPECT_NEAR(amplitude_seen(70.0, 80.0, 70.0), 6.43, 5e-3);
}

TEST(BandwidthResponse, EverySinusoidHasTheAmplitudeAndPhaseOfItsClosedForm) {
  for (const FilterOrder order : {FilterOrder::First, FilterOrder::Second}) {
    for (const double bandwidth_hz : {0.5, 20.0, 80.0, 3000.0}) {
      for (const double frequency_hz : {0.01, 3.0, 70.0, 99.9, 190.0, 1234.5, 9990.0}) {
        ImuModel::Setup setup = filtered(200.0, bandwidth_hz, order);
        setup.vibration = shaken(10.0, frequency_hz, 30.0);
        ImuModel model(setup);
        const double x = units::kPi * frequency_hz * 5e-3;
        const std::complex<double> gain = 10.0 * response(bandwidth_hz, order, frequency_hz) * 5e-3 * std::sin(x) / x;
        double worst = 0.0, worst_gyro = 0.0;
        for (std::int64_t k = 0; k <= 600; ++k) {
          const auto output = model.measure(Push().truth(k, 5000000));
          if (k == 0) continue;
          const double middle_s = (static_cast<double>(k) - 0.5) * 5e-3;
          const double phase = 2.0 * units::kPi * frequency_hz * middle_s + units::kPi / 6.0;
          const double expected = (gain * std::polar(1.0, phase)).imag();
          worst = std::max(worst, std::abs(output->sample.dv_b.x() - expected));
          worst_gyro = std::max(worst_gyro, std::abs(output->sample.dtheta_b.y() - expected));
        }
        // The inputs are 10 m/s^2 over 5 ms, of whose rounding 2e-15 is left: of a gain of 4e-9 that is 1e-5.
        EXPECT_LT(worst, 1e-6 * std::abs(gain) + 2e-15) << bandwidth_hz << ' ' << frequency_hz;
        EXPECT_LT(worst_gyro, 1e-6 * std::abs(gain) + 2e-15) << bandwidth_hz << ' ' << frequency_hz;
      }
    }
  }
}

/// The second-order filter by Runge-Kutta's method in `steps` steps an interval: y, y' and the integral of y.
class Reference {
 public:
  explicit Reference(double bandwidth_hz, double y) : w_(2.0 * units::kPi * bandwidth_hz), x_{y, 0.0, 0.0} {}
  void set_slope(double slope) { x_[1] = slope; }
  Reference with_bandwidth(double bandwidth_hz) const {
    Reference other = *this;
    other.w_ = 2.0 * units::kPi * bandwidth_hz;
    return other;
  }

  double increment(const std::function<double(double)>& u, double from_s, double dt_s, int steps) {
    x_[2] = 0.0;
    const double h = dt_s / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = from_s + i * h;
      const double u0 = u(t), u1 = u(t + 0.5 * h), u2 = u(t + h);
      const State k1 = rate(x_, u0), k2 = rate(moved(k1, 0.5 * h), u1), k3 = rate(moved(k2, 0.5 * h), u1);
      const State k4 = rate(moved(k3, h), u2);
      for (std::size_t j = 0; j < 3; ++j) x_[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
    return x_[2];
  }

 private:
  using State = std::array<double, 3>;
  State rate(const State& x, double u) const { return {x[1], w_ * w_ * (u - x[0]) - std::sqrt(2.0) * w_ * x[1], x[0]}; }
  State moved(const State& k, double h) const { return {x_[0] + h * k[0], x_[1] + h * k[1], x_[2] + h * k[2]}; }

  double w_;
  State x_;
};

TEST(BandwidthResponse, SwapsAndFadesOfAVibrationPassAsTheFilterAnswersThem) {
  // 9.5 Hz, fading to 170 Hz from 0.1 s on for 0.4321 s, and at once to 45 Hz at 0.7 s.
  ImuModel::Setup setup = filtered(200.0, 30.0, FilterOrder::Second);
  setup.vibration = shaken(2.0, 9.5, 20.0);
  ImuModel model(setup);
  const auto tone = [](double a, double f, double p, double t) {
    return a * std::sin(2.0 * units::kPi * f * t + p * units::kDeg);
  };
  const auto felt = [&](double t) {
    if (t >= 0.7) return tone(3.0, 45.0, 10.0, t);
    const double tau = std::min(std::max((t - 0.1) / 0.4321, 0.0), 1.0);
    const double weight = 0.5 - 0.5 * std::cos(units::kPi * tau);
    return (1.0 - weight) * tone(2.0, 9.5, 20.0, t) + weight * tone(5.0, 170.0, -90.0, t);
  };
  // In step with the vibration from the start: Im of H exp, and of its derivative.
  const std::complex<double> start =
      2.0 * response(30.0, FilterOrder::Second, 9.5) * std::polar(1.0, 20.0 * units::kDeg);
  Reference reference(30.0, start.imag());
  reference.set_slope((start * std::complex<double>(0.0, 2.0 * units::kPi * 9.5)).imag());
  model.measure(Push().truth(0, 5000000));
  for (std::int64_t k = 0; k < 200; ++k) {
    if (k == 20 || k == 140) {
      VibrationProfile next = k == 20 ? shaken(5.0, 170.0, -90.0) : shaken(3.0, 45.0, 10.0);
      next.request.fade_s = k == 20 ? 0.4321 : 0.0;
      model.apply(next);
    }
    const double t = static_cast<double>(k) * 5e-3;
    // The step at 0.7 s is between two intervals: the last of the first ends before it.
    const auto u = [&](double s) { return felt(k < 140 ? std::min(s, 0.7 - 1e-12) : std::max(s, 0.7)); };
    const double expected = reference.increment(u, t, 5e-3, 400);
    EXPECT_NEAR(model.measure(Push().truth(k + 1, 5000000))->sample.dv_b.x(), expected, 1e-9) << k;
  }
}

TEST(BandwidthResponse, ASwapOfTheBandwidthGoesOnFromTheFiltersState) {
  ImuModel::Setup setup = filtered(200.0, 30.0, FilterOrder::Second);
  setup.vibration = shaken(2.0, 130.0, 0.0);
  ImuModel model(setup);
  const auto felt = [](double t) { return 2.0 * std::sin(2.0 * units::kPi * 130.0 * t); };
  const std::complex<double> start = 2.0 * response(30.0, FilterOrder::Second, 130.0);
  Reference before(30.0, start.imag());
  before.set_slope((start * std::complex<double>(0.0, 2.0 * units::kPi * 130.0)).imag());
  model.measure(Push().truth(0, 5000000));
  for (std::int64_t k = 0; k < 20; ++k) {
    before.increment(felt, static_cast<double>(k) * 5e-3, 5e-3, 400);
    model.measure(Push().truth(k + 1, 5000000));
  }
  Reference after = before.with_bandwidth(10.0);
  model.apply(filtered(200.0, 10.0, FilterOrder::Second).errors);
  for (std::int64_t k = 20; k < 60; ++k) {
    const double expected = after.increment(felt, static_cast<double>(k) * 5e-3, 5e-3, 400);
    EXPECT_NEAR(model.measure(Push().truth(k + 1, 5000000))->sample.dv_b.x(), expected, 1e-9) << k;
  }
}

TEST(BandwidthResponse, RandomVibrationIsShapedBeforeItIsFoldedWithinItsChiSquareBand) {
  // As RandomVibration.TheMeasuredDensityIsTheTablesWithinItsChiSquareBand, with |H|^2 on every image.
  constexpr int kSegment = 512, kSegments = 128;
  constexpr double kDt = 5e-3, kBandwidthHz = 60.0;
  const std::vector<LinearRandomPoint> table = {{10.0, Vector3::Constant(0.4)}, {190.0, Vector3::Constant(0.4)}};
  ImuModel::Setup setup = filtered(200.0, kBandwidthHz, FilterOrder::Second);
  setup.vibration.linear_random = table;
  ImuModel model(setup);
  model.measure(Push().truth(0, 5000000));
  std::vector<double> power(kSegment / 2);
  Eigen::FFT<double> fft;
  std::int64_t k = 0;
  for (int s = 0; s < kSegments; ++s) {
    std::vector<std::complex<double>> samples, spectrum;
    for (int i = 0; i < kSegment; ++i) {
      const double hann = 0.5 - 0.5 * std::cos(2.0 * units::kPi * i / kSegment);
      samples.emplace_back(hann * model.measure(Push().truth(++k, 5000000))->sample.dv_b.x() / kDt);
    }
    fft.fwd(spectrum, samples);
    for (int i = 0; i < kSegment / 2; ++i) {
      power[i] += 2.0 * kDt * std::norm(spectrum[i]) / (0.375 * kSegment) / kSegments;
    }
  }
  const auto folded = [&](double f) {
    double sum = 0.0;
    for (const double image : {f, 200.0 - f}) {
      const double x = units::kPi * image * kDt;
      sum += Spectrum(table).density(0, image) * std::pow(std::sin(x) / x, 2) *
             std::norm(response(kBandwidthHz, FilterOrder::Second, image));
    }
    return sum;
  };
  const std::pair<double, double> bands[] = {{13.0, 30.0}, {30.0, 50.0}, {50.0, 70.0}, {70.0, 98.0}};
  for (const auto& [low_hz, high_hz] : bands) {
    double ratio = 0.0, bins = 0.0;
    for (int i = 0; i < kSegment / 2; ++i) {
      const double frequency_hz = i / (kSegment * kDt);
      if (frequency_hz < low_hz || frequency_hz > high_hz) continue;
      ratio += power[i] / folded(frequency_hz);
      bins += 1.0;
    }
    EXPECT_NEAR(ratio / bins, 1.0, 4.0 * std::sqrt(1.944 / (kSegments * bins))) << low_hz;
  }
}

/// Largest error of the increments of a force sin(2 pi f t) through a second-order filter of 20 Hz, as a rate.
double error_of_motion(double rate_hz, double frequency_hz, std::int64_t truths) {
  const double w = 2.0 * units::kPi * frequency_hz;
  const Push push{[w](double t) { return std::sin(w * t); }, [w](double t) { return (1.0 - std::cos(w * t)) / w; }};
  ImuModel model(filtered(rate_hz, 20.0, FilterOrder::Second));
  const double dt_s = 1.0 / rate_hz, x = 0.5 * w * dt_s;
  const std::complex<double> gain = response(20.0, FilterOrder::Second, frequency_hz) * std::sin(x) / x;
  const auto period_ns = static_cast<std::int64_t>(std::llround(1e9 * dt_s)) / truths;
  double worst = 0.0;
  for (std::int64_t k = 0; k <= static_cast<std::int64_t>(2.0 * rate_hz) * truths; ++k) {
    const auto output = model.measure(push.truth(k, period_ns));
    const double middle_s = static_cast<double>(k) * 1e-9 * static_cast<double>(period_ns) - 0.5 * dt_s;
    if (!output || middle_s < 1.0) continue;
    worst = std::max(worst, std::abs(output->sample.dv_b.x() / dt_s - (gain * std::polar(1.0, w * middle_s)).imag()));
  }
  return worst;
}

TEST(BandwidthResponse, OfTheMotionLeavesOutTermsOfHighOrderInTheTruthsStep) {
  const double at_100 = error_of_motion(100.0, 5.0, 1), at_200 = error_of_motion(200.0, 5.0, 1);
  const double at_400 = error_of_motion(400.0, 5.0, 1), slower = error_of_motion(100.0, 5.0, 4);
  EXPECT_LT(at_100, 1e-3);
  EXPECT_LT(at_200, 1e-4);
  EXPECT_LT(at_400, at_200 / 7.0);
  EXPECT_LT(slower, 2.0 * at_400 + 1e-9);
}

TEST(BandwidthResponse, OfAMovingVehicleWithAnArmIsThatOfTheForceAtTheImu) {
  const test::AnalyticMotion motion;
  ImuModel::Setup setup = filtered(200.0, 20.0, FilterOrder::Second);
  setup.installation.lever_arm_v_m = {0.8, -0.5, 1.5};
  ImuModel model(setup);
  model.measure(motion.truth(0, 5000000, kGravity));
  std::vector<Reference> force, rate;
  const Vector3 arm = setup.installation.lever_arm_v_m;
  for (int axis = 0; axis < 3; ++axis) {
    force.emplace_back(20.0, motion.f_v(0.0, arm, kGravity)[axis]);
    rate.emplace_back(20.0, motion.omega_iv_v(0.0)[axis]);
  }
  double worst_force = 0.0, worst_rate = 0.0;
  for (std::int64_t k = 0; k < 120; ++k) {
    const auto output = model.measure(motion.truth(k + 1, 5000000, kGravity));
    for (int axis = 0; axis < 3; ++axis) {
      const double t = static_cast<double>(k) * 5e-3;
      const double dv =
          force[axis].increment([&](double s) { return motion.f_v(s, arm, kGravity)[axis]; }, t, 5e-3, 20);
      const double dtheta = rate[axis].increment([&](double s) { return motion.omega_iv_v(s)[axis]; }, t, 5e-3, 20);
      if (k < 60) continue;  // exp(-88 * 0.3) is left of the start
      worst_force = std::max(worst_force, std::abs(output->sample.dv_b[axis] - dv) / 5e-3);
      worst_rate = std::max(worst_rate, std::abs(output->sample.dtheta_b[axis] - dtheta) / 5e-3);
    }
  }
  EXPECT_LT(worst_force, 1e-10);
  EXPECT_LT(worst_rate, 1e-11);
}

}  // namespace bandwidth_response_test
}  // namespace inslab::imu
