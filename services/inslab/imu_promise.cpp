#include "services/inslab/imu_promise.hpp"

#include <algorithm>
#include <cmath>

#include "samples/units.hpp"
#include "services/imu_error_injector/spectrum.hpp"

namespace inslab::cli {

namespace {

double mean_square(const Vector3& v) { return v.squaredNorm() / 3.0; }

/// Power of an interval's mean of a sinusoid against that of the sinusoid.
double mean_gain(double frequency_hz, double dt_s) {
  const double x = units::kPi * frequency_hz * dt_s;
  return std::pow(std::sin(x) / x, 2);
}

/// Sums `f(density averaged over the axes, frequency, width)` over the band of a spectrum.
template <class F>
double over_band(const imu::Spectrum& spectrum, const F& f) {
  if (spectrum.empty()) return 0.0;
  constexpr int kSteps = 20000;
  const double width_hz = (spectrum.highest_hz() - spectrum.lowest_hz()) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double frequency_hz = spectrum.lowest_hz() + (i + 0.5) * width_hz;
    double density = 0.0;
    for (int axis = 0; axis < 3; ++axis) density += spectrum.density(axis, frequency_hz) / 3.0;
    sum += f(density, frequency_hz, width_hz);
  }
  return sum;
}

bool is_plain(const ImuErrorProfile& errors) {
  return errors.gyro.bandwidth_hz.isZero(0.0) && errors.accel.bandwidth_hz.isZero(0.0) &&
         errors.gyro.full_scale_deg_per_s.isZero(0.0) && errors.accel.full_scale_g.isZero(0.0);
}
bool is_plain(const FaultProfile& fault) {
  const std::array<AxisFault, 3> none{};
  return fault.gyro_axes == none && fault.accel_axes == none && !fault.gyro_silent && !fault.accel_silent;
}

Vector3 root_of_squares(const Vector3& a, const Vector3& b) {
  return (a.cwiseProduct(a) + b.cwiseProduct(b)).cwiseSqrt();
}

}  // namespace

ImuPromise::ImuPromise(const LogSummary& summary, const SensorAddress& imu, std::int64_t sim_time_ns, double dt_s)
    : dt_s_(dt_s) {
  if (const AnyProfile* in_use = summary.in_use(ProfileKind::ImuError, imu, sim_time_ns)) {
    const auto& errors = std::get<ImuErrorProfile>(*in_use);
    gyro_density_ = errors.gyro.arw_deg_per_sqrt_h * units::kDegPerSqrtH;
    accel_density_ = errors.accel.vrw_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH;
    gyro_count_ = errors.gyro.quantization_arcsec * units::kArcsec;
    accel_count_ = errors.accel.quantization_m_per_s;
    is_plain_ = is_plain_ && cli::is_plain(errors);
  }
  if (const AnyProfile* in_use = summary.in_use(ProfileKind::Fault, imu, sim_time_ns)) {
    const auto& fault = std::get<FaultProfile>(*in_use);
    gyro_density_ = root_of_squares(gyro_density_, fault.gyro_noise_burst_deg_per_sqrt_h * units::kDegPerSqrtH);
    accel_density_ =
        root_of_squares(accel_density_, fault.accel_noise_burst_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH);
    is_plain_ = is_plain_ && cli::is_plain(fault);
  }
  if (const AnyProfile* in_use = summary.in_use(ProfileKind::Vibration, imu, sim_time_ns)) {
    vibration_ = std::get<VibrationProfile>(*in_use);
  }
}

/// A carried remainder r, uniform over a count q, errs by r[k] - r[k+1]: q^2/6; its first differences by q^2/2.
double ImuPromise::variance(const Vector3& density, const Vector3& count, double vibration, double count_gain) const {
  return mean_square(density) / dt_s_ + count_gain * mean_square(count) / (dt_s_ * dt_s_) + vibration;
}

double ImuPromise::gyro_sigma() const {
  return std::sqrt(variance(gyro_density_, gyro_count_, angular([](double) { return 1.0; }), 1.0 / 6.0));
}
double ImuPromise::accel_sigma() const {
  return std::sqrt(variance(accel_density_, accel_count_, linear([](double) { return 1.0; }), 1.0 / 6.0));
}
double ImuPromise::gyro_white_sigma() const {
  return std::sqrt(variance(gyro_density_, gyro_count_, angular(difference_gain()), 1.0 / 4.0));
}
double ImuPromise::accel_white_sigma() const {
  return std::sqrt(variance(accel_density_, accel_count_, linear(difference_gain()), 1.0 / 4.0));
}

ImuPromise::Gain ImuPromise::difference_gain() const {
  return [dt_s = dt_s_](double frequency_hz) { return 1.0 - std::cos(2.0 * units::kPi * frequency_hz * dt_s); };
}

/// A moving mount is part of the IMU's truth: it shows in no difference.
double ImuPromise::linear(const Gain& gain) const {
  if (vibration_.domain == VibrationDomain::Motion) return 0.0;
  double sum = over_band(imu::Spectrum(vibration_.linear_random), [&](double density, double f, double width) {
    return density * width * mean_gain(f, dt_s_) * gain(f);
  });
  for (const auto& term : vibration_.linear) {
    sum += 0.5 * mean_square(term.amplitude_m_per_s2) * mean_gain(term.frequency_hz, dt_s_) * gain(term.frequency_hz);
  }
  return sum;
}
double ImuPromise::angular(const Gain& gain) const {
  if (vibration_.domain == VibrationDomain::Motion) return 0.0;
  double sum = over_band(imu::Spectrum(vibration_.angular_random), [&](double density, double f, double width) {
    return density * width * mean_gain(f, dt_s_) * gain(f);
  });
  for (const auto& term : vibration_.angular) {
    sum += 0.5 * mean_square(term.amplitude_deg_per_s * units::kDeg) * mean_gain(term.frequency_hz, dt_s_) *
           gain(term.frequency_hz);
  }
  return sum;
}

double ImuPromise::mount_reach_m() const {
  if (vibration_.domain == VibrationDomain::Sensor) return 0.0;
  double reach_m = 0.0;
  for (const auto& term : vibration_.linear) {
    const double omega = 2.0 * units::kPi * term.frequency_hz;
    reach_m += term.amplitude_m_per_s2.cwiseAbs().maxCoeff() / (omega * omega);
  }
  return reach_m;
}

double ImuPromise::spread_error(double duration_s) const {
  double slowest_hz = 1e9;
  for (const auto& term : vibration_.linear) slowest_hz = std::min(slowest_hz, term.frequency_hz);
  for (const auto& term : vibration_.angular) slowest_hz = std::min(slowest_hz, term.frequency_hz);
  const double cut_off = 1.0 / (2.0 * units::kPi * slowest_hz * duration_s);
  // The variance of a Gaussian process of density S measured over T has the variance (integral of S^2) / T; its root
  // half of the relative error. Three axes are averaged; 4 standard errors as everywhere.
  const auto of_band = [&](const imu::Spectrum& spectrum) {
    const double power = over_band(spectrum, [](double density, double, double width) { return density * width; });
    const double squares =
        over_band(spectrum, [](double density, double, double width) { return density * density * width; });
    return power == 0.0 ? 0.0 : 4.0 * 0.5 * std::sqrt(squares / (3.0 * duration_s)) / power;
  };
  return cut_off +
         std::max(of_band(imu::Spectrum(vibration_.linear_random)), of_band(imu::Spectrum(vibration_.angular_random)));
}

}  // namespace inslab::cli
