#include "inslab/referee/predict/sensor_terms.hpp"

#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/noise/random/flicker.hpp"

namespace inslab::predict {
namespace {

using imu::TriadParameters;

/// Collects the terms of one triad.
class Collector {
 public:
  Collector(Triad triad, std::vector<SensorTerm>& terms) : triad_(triad), terms_(terms) {}

  template <class Amplitudes>
  void add(TermKind kind, const Amplitudes& amplitudes) {
    for (Eigen::Index i = 0; i < amplitudes.size(); ++i) add(kind, static_cast<int>(i), amplitudes[i]);
  }
  template <class Sigmas>
  void add_gauss_markov(TermKind kind, const Sigmas& sigma, const Sigmas& correlation_time_s) {
    for (Eigen::Index i = 0; i < sigma.size(); ++i) add(kind, static_cast<int>(i), sigma[i], correlation_time_s[i]);
  }
  void add_flicker(const Vector3& instability) {
    constexpr double kInterval_s = 1.0;
    for (int i = 0; i < 3 * random::Flicker::terms(kInterval_s); ++i) {
      const auto process = random::Flicker::process(i / 3, kInterval_s);
      add(TermKind::BiasFlicker, i, process.sigma * instability[i % 3], process.correlation_time_s);
    }
  }

 private:
  void add(TermKind kind, int index, double amplitude,
           double correlation_time_s = std::numeric_limits<double>::infinity()) {
    if (amplitude != 0.0) terms_.push_back({triad_, kind, index, amplitude, correlation_time_s});
  }

  Triad triad_;
  std::vector<SensorTerm>& terms_;
};

/// n F (x/F)^3 by its coefficient of x^3.
Vector3 cubes(const TriadParameters& triad) {
  Vector3 cube = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double of_full_scale = triad.nonlinearity_of_full_scale[axis], full_scale = triad.full_scale[axis];
    if (of_full_scale != 0.0) cube[axis] = of_full_scale / (full_scale * full_scale);
  }
  return cube;
}

void collect(const TriadParameters& triad, Collector collector) {
  collector.add(TermKind::BiasConstant, triad.bias_constant);
  collector.add(TermKind::BiasTurnOn, triad.bias_turn_on_sigma);
  collector.add_gauss_markov(TermKind::BiasGaussMarkov, triad.bias_gm_sigma, triad.bias_gm_correlation_time_s);
  collector.add(TermKind::BiasRandomWalk, triad.bias_random_walk);
  collector.add_flicker(triad.bias_instability);
  collector.add(TermKind::BiasTemperature, triad.bias_per_deg_c);
  collector.add(TermKind::BiasTemperatureRate, triad.bias_per_warming);
  collector.add(TermKind::ScaleConstant, triad.scale_factor);
  collector.add(TermKind::ScaleTurnOn, triad.scale_factor_turn_on_sigma);
  collector.add_gauss_markov(TermKind::ScaleGaussMarkov, triad.scale_factor_gm_sigma,
                             triad.scale_factor_gm_correlation_time_s);
  collector.add(TermKind::ScaleTemperature, triad.scale_factor_per_deg_c);
  collector.add(TermKind::Asymmetry, Vector3(0.5 * triad.scale_factor_asymmetry));
  collector.add(TermKind::Cube, cubes(triad));
  collector.add(TermKind::Square, triad.nonlinearity_by_input);
  collector.add(TermKind::CrossAxis, triad.cross_axis_rad);
  collector.add_gauss_markov(TermKind::CrossAxisGaussMarkov, triad.cross_axis_gm_sigma_rad,
                             triad.cross_axis_gm_correlation_time_s);
}

/// Cross-axis angles in their order x to y, x to z, y to x, y to z, z to x, z to y.
constexpr int kLeansTo[] = {0, 0, 1, 1, 2, 2}, kLeaning[] = {1, 2, 0, 2, 0, 1};

}  // namespace

std::vector<SensorTerm> terms_of(const ImuErrorProfile& profile) {
  std::vector<SensorTerm> terms;
  Collector gyro(Triad::Gyro, terms);
  collect(imu::gyros_in_si(profile), gyro);
  gyro.add(TermKind::GSensitivity, Vector9(profile.gyro.g_sensitivity_deg_per_h_per_g * (units::kDegPerH / units::kG)));
  constexpr double kPerG2 = units::kDegPerH / (units::kG * units::kG);
  constexpr double kPerRate2 = units::kDegPerH / (units::kDegPerS * units::kDegPerS);
  gyro.add(TermKind::GSquare, Vector9(profile.gyro_g2_sensitivity_deg_per_h_per_g2 * kPerG2));
  gyro.add(TermKind::GProduct, Vector9(profile.gyro_anisoelasticity_deg_per_h_per_g2 * kPerG2));
  gyro.add(TermKind::RateProduct, Vector9(profile.gyro_anisoinertia_deg_per_h_per_deg2_per_s2 * kPerRate2));
  collect(imu::accels_in_si(profile), Collector(Triad::Accel, terms));
  return terms;
}

Vector3 effect(const SensorTerm& term, const SensedMotion& motion) {
  const SensedMeans& sensed = term.triad == Triad::Gyro ? motion.gyro : motion.accel;
  const auto along = [&](int axis, double input) { return Vector3(term.amplitude * input * Vector3::Unit(axis)); };
  const int i = term.index;
  switch (term.kind) {
    case TermKind::BiasConstant:
    case TermKind::BiasTurnOn:
    case TermKind::BiasGaussMarkov:
    case TermKind::BiasRandomWalk:
      return along(i, 1.0);
    case TermKind::BiasFlicker:
      return along(i % 3, 1.0);
    case TermKind::BiasTemperature:
      return along(i, motion.warmer_k);
    case TermKind::BiasTemperatureRate:
      return along(i, motion.warming_k_per_s);
    case TermKind::ScaleConstant:
    case TermKind::ScaleTurnOn:
    case TermKind::ScaleGaussMarkov:
      return along(i, sensed.x[i]);
    case TermKind::ScaleTemperature:
      return along(i, motion.warmer_k * sensed.x[i]);
    case TermKind::Asymmetry:
      return along(i, sensed.abs[i]);
    case TermKind::Cube:
      return along(i, sensed.cube[i]);
    case TermKind::Square:
      return along(i, sensed.square[i]);
    case TermKind::CrossAxis:
    case TermKind::CrossAxisGaussMarkov:
      return along(kLeaning[i], sensed.x[kLeansTo[i]]);
    case TermKind::GSensitivity:
      return along(i / 3, motion.accel.x[i % 3]);
    case TermKind::GSquare:
      return along(i / 3, motion.accel.square[i % 3]);
    case TermKind::GProduct:
      return along(i / 3, motion.accel.product[i % 3]);
    case TermKind::RateProduct:
      return along(i / 3, motion.gyro.product[i % 3]);
  }
  return Vector3::Zero();
}

}  // namespace inslab::predict
