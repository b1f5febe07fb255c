#include "inslab/referee/verify/vibration_block.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::verify {
namespace {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kDt = 5e-3;
const nav::Geodetic kPlace{30.0 * units::kDeg, 114.0 * units::kDeg, 20.0};

/// What the trajectory server says of a vehicle at rest, level, its nose to the north.
TruthState rest(std::int64_t k, const nav::Gravity& gravity) {
  TruthState truth;
  truth.header.sim_time_ns = k * kPeriodNs;
  truth.latitude_rad = kPlace.latitude_rad;
  truth.longitude_rad = kPlace.longitude_rad;
  truth.height_m = kPlace.height_m;
  truth.omega_iv_v = nav::omega_ie_n(kPlace.latitude_rad);
  truth.f_v = -gravity.g_n(kPlace);
  if (k == 0) return truth;
  truth.interval_ns = kPeriodNs;
  truth.dtheta_v = truth.omega_iv_v * kDt;
  truth.dv_v = truth.f_v * kDt;
  return truth;
}

/// Runs a perfect IMU that shakes; `use` gets each output.
template <class Use>
void shake(const ImuOf& imu_of, const VibrationProfile& vibration, std::uint64_t seed, double duration_s,
           const Use& use) {
  const nav::Gravity gravity;
  const Imu imu = imu_of({seed, 0, time::Rate(200.0), gravity, {}, vibration, {}});
  const auto samples = static_cast<std::int64_t>(std::llround(duration_s / kDt));
  for (std::int64_t k = 0; k <= samples; ++k) {
    if (const auto output = imu(rest(k, gravity))) use(*output);
  }
}

VibrationProfile profile_of(const TwoAxisMotion& motion, VibrationDomain domain) {
  VibrationProfile profile;
  profile.domain = domain;
  const double rate_deg_per_s = motion.theta_rad / units::kDeg * 2.0 * units::kPi * motion.frequency_hz;
  const bool coning = motion.a_m_per_s2 == 0.0;
  // Coning: rates cos and sin, angles sin and -cos. Sculling: rate cos about x, so angle sin; force sin along y.
  profile.angular.push_back(
      {Vector3(rate_deg_per_s, coning ? rate_deg_per_s : 0.0, 0.0), motion.frequency_hz, Vector3(90.0, 0.0, 0.0)});
  if (!coning) profile.linear.push_back({Vector3(0.0, motion.a_m_per_s2, 0.0), motion.frequency_hz, Vector3::Zero()});
  return profile;
}

/// Welch's estimate with Hann windows that do not overlap: one-sided, of mean rates.
class Periodogram {
 public:
  static constexpr int kSegment = 1024;

  void add(double rate) {
    const double window = 0.5 - 0.5 * std::cos(2.0 * units::kPi * static_cast<double>(samples_.size()) / kSegment);
    samples_.emplace_back(window * rate);
    if (samples_.size() < kSegment) return;
    std::vector<std::complex<double>> spectrum;
    fft_.fwd(spectrum, samples_);
    for (std::size_t i = 0; i < power_.size(); ++i) power_[i] += std::norm(spectrum[i]);
    samples_.clear();
    segments_ += 1.0;
  }
  double segments() const { return segments_; }
  static double frequency_hz(std::size_t bin) { return static_cast<double>(bin) / (kSegment * kDt); }
  /// 2 dt |X|^2 over the window's sum of squares, 3/8 of the segment.
  double density(std::size_t bin) const { return 2.0 * kDt * power_[bin] / (0.375 * kSegment * segments_); }

 private:
  Eigen::FFT<double> fft_;
  std::vector<std::complex<double>> samples_;
  std::vector<double> power_ = std::vector<double>(kSegment / 2, 0.0);
  double segments_ = 0.0;
};

/// What the mean over dt makes of the table at a frequency below half the sample rate: the sum of its images.
double density_of_means(const imu::Spectrum& spectrum, int axis, double frequency_hz) {
  double sum = 0.0;
  for (int m = -50; m <= 50; ++m) {
    const double image_hz = std::abs(frequency_hz + m / kDt);
    const double x = units::kPi * image_hz * kDt;
    sum += spectrum.density(axis, image_hz) * std::pow(std::sin(x) / x, 2);
  }
  return sum;
}

/// Quantile of chi-square over its degrees of freedom n (Wilson and Hilferty, 1931), for the normal quantile z.
double chi_square_ratio(double n, double z) {
  const double v = 2.0 / (9.0 * n);
  return std::pow(1.0 - v + z * std::sqrt(v), 3);
}

/// Flat bands and slopes; half of the power above half of the sample rate.
std::vector<LinearRandomPoint> random_table() {
  return {{8.0, {0.02, 0.05, 0.2}},
          {20.0, {0.1, 0.05, 0.1}},
          {60.0, {0.1, 0.05, 0.1}},
          {110.0, {0.05, 0.05, 0.3}},
          {400.0, {0.01, 0.05, 0.3}}};
}

Table sinusoid_table(const Subjects& subjects) {
  Table table;
  table.title = "Sinusoids of 10 m/s^2 at 200 Hz: increments against differences of the antiderivative, 10 s";
  table.columns = {"frequency Hz", "worst m/s", "limit m/s", "largest increment m/s", "a sample's a dt m/s"};
  for (const double frequency_hz : {12.5, 99.0, 130.0, 210.0, 1234.5}) {
    const SinusoidResult result = verify_sinusoid(frequency_hz, subjects);
    // Within a second a phase of f turns is good to four roundings of itself, 8 pi f 2^-53 rad; an increment is at most
    // a / (pi f).
    const double limit = 8.0 * 0x1p-53 * 10.0;
    table.rows.push_back(
        {{fmt::format("{}", frequency_hz), fmt::format("{:.1e}", result.worst_m_per_s), fmt::format("{:.1e}", limit),
          fmt::format("{:.5f}", result.largest_m_per_s), fmt::format("{:.5f}", result.sampled_m_per_s)},
         result.worst_m_per_s <= limit});
  }
  table.notes = {"Above 100 Hz an instantaneous sample times dt would alias with the last column's amplitude."};
  return table;
}

Table two_axis_table(const Subjects& subjects) {
  Table table;
  table.title = "Two-axis vibration in the two-sample mechanization, 20 s: drift about or along z";
  table.columns = {"motion", "domain", "f Hz", "textbook", "measured", "relative difference", "limit"};
  const TwoAxisMotion motions[] = {{10.0, 1.0 * units::kDeg, 0.0},   {25.0, 0.5 * units::kDeg, 0.0},
                                   {40.0, 0.2 * units::kDeg, 0.0},   {10.0, 0.2 * units::kDeg, 50.0},
                                   {25.0, 0.1 * units::kDeg, 100.0}, {40.0, 0.05 * units::kDeg, 100.0}};
  for (const TwoAxisMotion& motion : motions) {
    const bool coning = motion.a_m_per_s2 == 0.0;
    const double residual = two_sample_residual(motion, kDt);
    for (const VibrationDomain domain : {VibrationDomain::Motion, VibrationDomain::Sensor}) {
      const bool moves = domain == VibrationDomain::Motion;
      const double expected = moves ? -residual : pretended_drift(motion) - residual;
      const double measured = measured_drift(motion, domain, 20.0, subjects);
      const double difference = std::abs(measured / expected - 1.0);
      const double limit = moves ? 0.02 : 0.001;
      const double scale = coning ? 3600.0 / units::kDeg : 1e6;
      const char* unit = coning ? "deg/h" : "um/s^2";
      table.rows.push_back(
          {{coning ? "coning" : "sculling", std::string(enum_name(domain)), fmt::format("{}", motion.frequency_hz),
            fmt::format("{:.6g} {}", expected * scale, unit), fmt::format("{:.6g} {}", measured * scale, unit),
            fmt::format("{:.1e}", difference), fmt::format("{}", limit)},
           difference <= limit});
    }
  }
  table.notes = {
      "motion: what the algorithm loses of a motion that is in the truth. sensor: what vibration in the output alone "
      "makes of a vehicle at rest. The textbook's formulas hold to first order in the angle squared; the limits are "
      "for "
      "what they and the mechanization leave out at these angles."};
  return table;
}

Table random_table_of(const std::vector<std::uint64_t>& seeds, const Subjects& subjects) {
  Table table;
  table.title = fmt::format(
      "Random vibration, 20 minutes at 200 Hz, {} record(s): density of interval means over the "
      "table's, images above 100 Hz included",
      seeds.size());
  table.columns = {"axis, band Hz", "(m/s^2)^2/Hz", "ratio", "lower", "upper", "degrees of freedom"};
  for (const BandResult& band : verify_random(random_table(), seeds, 1200.0, subjects)) {
    table.rows.push_back(
        {{fmt::format("{} {:.0f} to {:.0f}", "xyz"[band.axis], band.low_hz, band.high_hz),
          fmt::format("{:.4f}", band.expected), fmt::format("{:.4f}", band.ratio), fmt::format("{:.4f}", band.lower),
          fmt::format("{:.4f}", band.upper), fmt::format("{:.0f}", band.degrees_of_freedom)},
         band.ratio >= band.lower && band.ratio <= band.upper});
  }
  table.notes = {"Limits: 99.9 % of chi-square. The table has corners at 8, 20, 60, 110 and 400 Hz."};
  return table;
}

}  // namespace

SinusoidResult verify_sinusoid(double frequency_hz, const Subjects& subjects) {
  constexpr double kAmplitude = 10.0, kPhaseDeg = 30.0;
  VibrationProfile vibration;
  vibration.linear.push_back({Vector3(kAmplitude, 0.0, 0.0), frequency_hz, Vector3(kPhaseDeg, 0.0, 0.0)});
  SinusoidResult result;
  result.frequency_hz = frequency_hz;
  result.sampled_m_per_s = kAmplitude * kDt;
  constexpr long double kPiL = 3.14159265358979323846264338327950288L;
  const long double omega = 2.0L * kPiL * static_cast<long double>(frequency_hz);
  const auto antiderivative = [&](std::int64_t k) {
    return -kAmplitude / omega * std::cos(omega * static_cast<long double>(k) / 200.0L + kPiL / 6.0L);
  };
  std::int64_t k = 0;
  shake(subjects.imu, vibration, 1, 10.0, [&](const imu::ImuModel::Output& output) {
    const double increment = output.truth.accel_error.vibration.x();
    const long double exact = antiderivative(k + 1) - antiderivative(k);
    ++k;
    result.worst_m_per_s = std::max(result.worst_m_per_s, static_cast<double>(std::abs(increment - exact)));
    result.largest_m_per_s = std::max(result.largest_m_per_s, std::abs(increment));
  });
  return result;
}

double two_sample_residual(const TwoAxisMotion& motion, double dt_s) {
  const double x = 2.0 * units::kPi * motion.frequency_hz * dt_s;
  const double half = std::sin(0.5 * x);
  const double lost = 0.5 * (x - std::sin(x)) - half * half * std::sin(x) / 3.0;
  if (motion.a_m_per_s2 == 0.0) return motion.theta_rad * motion.theta_rad / dt_s * lost;
  return motion.theta_rad * motion.a_m_per_s2 / x * lost;
}

double pretended_drift(const TwoAxisMotion& motion) {
  if (motion.a_m_per_s2 == 0.0) return motion.theta_rad * motion.theta_rad * units::kPi * motion.frequency_hz;
  const double g = nav::Gravity().g_n(kPlace).z();
  return 0.5 * motion.theta_rad * motion.a_m_per_s2 + 0.25 * g * motion.theta_rad * motion.theta_rad;
}

double measured_drift(const TwoAxisMotion& motion, VibrationDomain domain, double duration_s,
                      const Subjects& subjects) {
  nav::Strapdown::Options options;
  options.full_rotation_term = true;
  std::unique_ptr<Mechanization> strapdown;
  Vector3 turn_start, turn_rad, v_start, v_m_per_s;
  shake(subjects.imu, profile_of(motion, domain), 1, duration_s + kDt, [&](const imu::ImuModel::Output& output) {
    const nav::ImuIncrements increments{output.sample.dtheta_b, output.sample.dv_b, kDt};
    const nav::NavState truth = nav_state(output.truth);
    const bool starts = !strapdown;
    if (starts) {
      strapdown = subjects.mechanization(truth, nav::Gravity(), options, increments);
    } else {
      strapdown->advance(increments);
    }
    const nav::NavState found = strapdown->state();
    turn_rad = nav::rotation_vector_from_quaternion(truth.q_nb.conjugate() * found.q_nb);
    v_m_per_s = found.v_n - truth.v_n;
    if (starts) {
      turn_start = turn_rad;
      v_start = v_m_per_s;
    }
  });
  const Vector3 drift = motion.a_m_per_s2 == 0.0 ? Vector3(turn_rad - turn_start) : Vector3(v_m_per_s - v_start);
  return drift.z() / duration_s;
}

std::vector<BandResult> verify_random(const std::vector<LinearRandomPoint>& table,
                                      const std::vector<std::uint64_t>& seeds, double duration_s,
                                      const Subjects& subjects) {
  VibrationProfile vibration;
  vibration.linear_random = table;
  std::array<Periodogram, 3> axes;
  for (const std::uint64_t seed : seeds) {
    shake(subjects.imu, vibration, seed, duration_s, [&axes](const imu::ImuModel::Output& output) {
      for (int axis = 0; axis < 3; ++axis) axes[axis].add(output.truth.accel_error.vibration[axis] / kDt);
    });
  }
  const imu::Spectrum spectrum(table);
  constexpr double kEdges[] = {10.0, 18.0, 22.0, 40.0, 58.0, 62.0, 88.0, 92.0, 98.0};
  std::vector<BandResult> results;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i + 1 < std::size(kEdges); ++i) {
      BandResult band{axis, kEdges[i], kEdges[i + 1]};
      double measured = 0.0, bins = 0.0;
      for (std::size_t bin = 0; bin < Periodogram::kSegment / 2; ++bin) {
        const double frequency_hz = Periodogram::frequency_hz(bin);
        if (frequency_hz < band.low_hz || frequency_hz > band.high_hz) continue;
        measured += axes[axis].density(bin);
        band.expected += density_of_means(spectrum, axis, frequency_hz);
        bins += 1.0;
      }
      band.ratio = measured / band.expected;
      band.expected /= bins;
      // Two a bin and segment; a Hann window makes neighbours and next ones alike: 4/9 and 1/36 of their power.
      band.degrees_of_freedom = 2.0 * bins * axes[axis].segments() / (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0));
      constexpr double kNormal999 = 3.2905;
      band.lower = chi_square_ratio(band.degrees_of_freedom, -kNormal999);
      band.upper = chi_square_ratio(band.degrees_of_freedom, kNormal999);
      results.push_back(band);
    }
  }
  return results;
}

std::vector<Table> vibration_tables(bool full, const Subjects& subjects) {
  std::vector<std::uint64_t> seeds{1};
  for (std::uint64_t seed = 2; full && seed <= 20; ++seed) seeds.push_back(seed);
  return {sinusoid_table(subjects), two_axis_table(subjects), random_table_of(seeds, subjects)};
}

}  // namespace inslab::verify
