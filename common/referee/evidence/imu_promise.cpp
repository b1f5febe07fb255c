#include "inslab/referee/evidence/imu_promise.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/spectrum.hpp"

namespace inslab::evidence {

namespace {

/// Power of an interval's mean of a sinusoid against that of the sinusoid.
double mean_gain(double frequency_hz, double dt_s) {
  const double x = units::kPi * frequency_hz * dt_s;
  return std::pow(std::sin(x) / x, 2);
}

/// Sums `f(density of the axes, frequency, width)` over the band of a spectrum.
template <class F>
double over_band(const imu::Spectrum& spectrum, const F& f) {
  if (spectrum.empty()) return 0.0;
  constexpr int kSteps = 20000;
  const double width_hz = (spectrum.highest_hz() - spectrum.lowest_hz()) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double frequency_hz = spectrum.lowest_hz() + (i + 0.5) * width_hz;
    Vector3 density;
    for (int axis = 0; axis < 3; ++axis) density[axis] = spectrum.density(axis, frequency_hz);
    sum += f(density, frequency_hz, width_hz);
  }
  return sum;
}

bool has_faulty_axis(const FaultProfile& fault) {
  const std::array<AxisFault, 3> none{};
  return fault.gyro_axes != none || fault.accel_axes != none || fault.gyro_silent || fault.accel_silent ||
         !fault.common.are_none();
}

/// Variance of exact flicker of B = 1 about a straight line through n samples: (ln n - 0.737)/pi, of the Gauss-Markov
/// processes that stand for it (noise/random/flicker.hpp) within 1 % from 200 samples on.
double flicker_about_a_line(std::uint64_t samples) {
  return std::max(std::log(static_cast<double>(samples)) - 0.737, 0.0) / units::kPi;
}
/// Half the mean square of its first differences: its Allan variance, of any length.
constexpr double kFlickerDifferences = 0.441271;  // 2 ln 2 / pi

Vector3 root_of_squares(const Vector3& a, const Vector3& b) {
  return (a.cwiseProduct(a) + b.cwiseProduct(b)).cwiseSqrt();
}

}  // namespace

ImuPromise::ImuPromise(const LogSummary& summary, const SensorAddress& imu, std::int64_t sim_time_ns, double dt_s)
    : dt_s_(dt_s) {
  if (const catalog::AnyProfile* in_use = summary.in_use(ProfileKind::ImuError, imu, sim_time_ns)) {
    take(std::get<ImuErrorProfile>(*in_use));
  }
  if (const catalog::AnyProfile* in_use = summary.in_use(ProfileKind::Fault, imu, sim_time_ns)) {
    take(std::get<FaultProfile>(*in_use));
  }
  if (const catalog::AnyProfile* in_use = summary.in_use(ProfileKind::Vibration, imu, sim_time_ns)) {
    vibration_ = std::get<VibrationProfile>(*in_use);
  }
}

void ImuPromise::take(const ImuErrorProfile& errors) {
  gyro_.density = errors.gyro.arw_deg_per_sqrt_h * units::kDegPerSqrtH;
  accel_.density = errors.accel.vrw_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH;
  gyro_.instability = errors.gyro.bias_instability_deg_per_h * units::kDegPerH;
  accel_.instability = errors.accel.bias_instability_mgal * units::kMGal;
  gyro_.count = errors.gyro.quantization_arcsec * units::kArcsec;
  accel_.count = errors.accel.quantization_m_per_s;
  is_filtered_ = !errors.gyro.bandwidth_hz.isZero(0.0) || !errors.accel.bandwidth_hz.isZero(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    gyro_.filter[axis] = FilterResponse(errors.gyro.bandwidth_hz[i], errors.gyro.bandwidth_order, dt_s_);
    accel_.filter[axis] = FilterResponse(errors.accel.bandwidth_hz[i], errors.accel.bandwidth_order, dt_s_);
    for (const FilterResponse* filter : {&gyro_.filter[axis], &accel_.filter[axis]}) {
      white_correlation_ = std::max(white_correlation_, filter->white_correlation());
      difference_correlation_ = std::max(difference_correlation_, filter->difference_correlation());
    }
  }
}

void ImuPromise::take(const FaultProfile& fault) {
  gyro_.density = root_of_squares(gyro_.density, fault.gyro_noise_burst_deg_per_sqrt_h * units::kDegPerSqrtH);
  accel_.density = root_of_squares(accel_.density, fault.accel_noise_burst_m_per_s_per_sqrt_h * units::kMPerSPerSqrtH);
  if (has_faulty_axis(fault)) why_not_ = "a fault '" + fault.name + "' of an axis was in effect";
}

/// A carried remainder r, uniform over a count q, errs by r[k] - r[k+1]: q^2/6; its first differences by q^2/2.
double ImuPromise::variance(const Triad& triad, double vibration, Of of, double flicker_per_B2) const {
  double sum = vibration;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const FilterResponse& filter = triad.filter[axis];
    const double noise = of == Of::Values ? filter.white_gain() : filter.difference_gain();
    const double counts = of == Of::Values ? 1.0 / 6.0 : 1.0 / 4.0;
    // The filter takes of flicker's differences what it takes of white ones; its slow part it leaves.
    const double flicker = flicker_per_B2 * (of == Of::Values ? 1.0 : noise);
    sum +=
        (triad.density[i] * triad.density[i] * noise / dt_s_ + triad.instability[i] * triad.instability[i] * flicker +
         triad.count[i] * triad.count[i] * counts / (dt_s_ * dt_s_)) /
        3.0;
  }
  return sum;
}

double ImuPromise::gyro_sigma(std::uint64_t samples) const {
  return std::sqrt(variance(gyro_, angular(Of::Values), Of::Values, flicker_about_a_line(samples)));
}
double ImuPromise::accel_sigma(std::uint64_t samples) const {
  return std::sqrt(variance(accel_, linear(Of::Values), Of::Values, flicker_about_a_line(samples)));
}
double ImuPromise::gyro_white_sigma() const {
  return std::sqrt(variance(gyro_, angular(Of::Differences), Of::Differences, kFlickerDifferences));
}
double ImuPromise::accel_white_sigma() const {
  return std::sqrt(variance(accel_, linear(Of::Differences), Of::Differences, kFlickerDifferences));
}

/// An octave of flicker has the variance B^2 ln 2 / pi = 0.22 B^2. The slowest in a window has about two independent
/// values, each next one twice as many: the sum's variance has the standard error 0.22 B^2 sqrt(2 (1/2 + 1/4 + ...)),
/// over sqrt(3) for three axes 0.18 B^2, and the root of it half of that over sigma.
double ImuPromise::sigma_error(const Triad& triad, double sigma) {
  return sigma > 0.0 ? 4.0 * 0.18 * triad.instability.squaredNorm() / 3.0 / (2.0 * sigma) : 0.0;
}

/// What is left of the power of each axis at a frequency, averaged over the axes.
double ImuPromise::passed(const Triad& triad, const Vector3& power, double frequency_hz, Of of) const {
  const double differences = of == Of::Values ? 1.0 : 1.0 - std::cos(2.0 * units::kPi * frequency_hz * dt_s_);
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value = power[static_cast<Eigen::Index>(axis)];
    if (value > 0.0) sum += value * (is_filtered_ ? triad.filter[axis].vibration_power_at(frequency_hz) : 1.0) / 3.0;
  }
  return sum * differences * mean_gain(frequency_hz, dt_s_);
}

/// A moving mount is part of the IMU's truth: it shows in no difference.
double ImuPromise::linear(Of of) const {
  if (vibration_.domain == VibrationDomain::Motion) return 0.0;
  double sum = over_band(
      imu::Spectrum(vibration_.linear_random),
      [&](const Vector3& density, double f, double width_hz) { return passed(accel_, density * width_hz, f, of); });
  for (const auto& term : vibration_.linear) {
    sum += passed(accel_, 0.5 * term.amplitude_m_per_s2.cwiseAbs2(), term.frequency_hz, of);
  }
  return sum;
}
double ImuPromise::angular(Of of) const {
  if (vibration_.domain == VibrationDomain::Motion) return 0.0;
  double sum = over_band(
      imu::Spectrum(vibration_.angular_random),
      [&](const Vector3& density, double f, double width_hz) { return passed(gyro_, density * width_hz, f, of); });
  for (const auto& term : vibration_.angular) {
    sum += passed(gyro_, 0.5 * (term.amplitude_deg_per_s * units::kDeg).cwiseAbs2(), term.frequency_hz, of);
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
    const double power =
        over_band(spectrum, [](const Vector3& density, double, double width) { return density.mean() * width; });
    const double squares = over_band(
        spectrum, [](const Vector3& density, double, double width) { return density.mean() * density.mean() * width; });
    return power == 0.0 ? 0.0 : 4.0 * 0.5 * std::sqrt(squares / (3.0 * duration_s)) / power;
  };
  return cut_off +
         std::max(of_band(imu::Spectrum(vibration_.linear_random)), of_band(imu::Spectrum(vibration_.angular_random)));
}

}  // namespace inslab::evidence
