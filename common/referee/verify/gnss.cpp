#include "inslab/referee/verify/gnss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/noise/allan/confidence.hpp"
#include "inslab/referee/verify/allan_block.hpp"
#include "inslab/referee/verify/estimates.hpp"
#include "inslab/referee/verify/run_start.hpp"

namespace inslab::verify {

namespace {

constexpr double kCircling_s = 1200.0;
constexpr double kRate_hz = 10.0;  ///< on the circle
constexpr std::array<double, 3> kPositionGradesM{0.03, 0.3, 3.0};
constexpr std::array<double, 3> kVelocityGradesMPerS{0.05, 0.5, 5.0};
const Vector3 kAntennaArm_v_m(0.4, -0.3, -1.6);
const Vector3 kImuArm_v_m(-1.1, 0.2, 0.3);

scenario::Motion swinging_rate(scenario::Axis axis, double amplitude_deg_per_s, double period_s) {
  scenario::Motion motion;
  motion.type = scenario::MotionType::SineRate;
  motion.axis = axis;
  motion.amplitude_deg_per_s = amplitude_deg_per_s;
  motion.period_s = period_s;
  return motion;
}

scenario::Motion constant_rate(scenario::Axis axis, double rate_deg_per_s) {
  scenario::Motion motion;
  motion.type = scenario::MotionType::ConstantRate;
  motion.axis = axis;
  motion.rate_deg_per_s = rate_deg_per_s;
  return motion;
}

/// A vehicle at 10 m/s that turns all the time, without sensors.
scenario::LoadedScenario turning(double duration_s, double rate_hz, const std::vector<scenario::Motion>& motions) {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.duration_s = duration_s;
  s.truth_rate_hz = rate_hz;
  s.trajectory.initial.latitude_deg = 30.53;
  s.trajectory.initial.longitude_deg = 114.35;
  s.trajectory.initial.height_m = 5000.0;
  s.trajectory.initial.speed_m_per_s = 10.0;
  s.trajectory.segments.push_back({"turn", duration_s, motions, true});
  loaded.truth_rate = time::Rate(rate_hz);
  loaded.truth_samples = 1 + static_cast<std::uint64_t>(duration_s * rate_hz);
  return loaded;
}

scenario::LoadedGnss receiver(std::uint32_t number, double rate_hz, const GnssErrorProfile& errors) {
  scenario::LoadedGnss gnss;
  gnss.number = number;
  gnss.rate = time::Rate(rate_hz);
  gnss.errors = errors;
  gnss.installation.lever_arm_v_m = kAntennaArm_v_m;
  gnss.errors.target = gnss.installation.target = {SensorKind::Gnss, number};
  return gnss;
}

Matrix3 C_en_at(const nav::Geodetic& place) { return nav::C_en(place.latitude_rad, place.longitude_rad); }

/// Position in e of a point of the vehicle, straight through ECEF: none of the emulator's code.
Vector3 point_e_m(const TruthState& truth, const Vector3& arm_v_m) {
  const nav::Geodetic vehicle = geodetic_of(truth);
  return nav::ecef_from_geodetic(vehicle) + C_en_at(vehicle) * (truth.q_nv.toRotationMatrix() * arm_v_m);
}

/// Its velocity relative to e in e, m/s.
Vector3 point_v_e_m_per_s(const TruthState& truth, const Vector3& arm_v_m) {
  const Matrix3 C_ev = C_en_at(geodetic_of(truth)) * truth.q_nv.toRotationMatrix();
  const Vector3 omega_ie_v = C_ev.transpose() * Vector3(0.0, 0.0, nav::wgs84::omega_e_rad_per_s);
  return C_en_at(geodetic_of(truth)) * truth.v_n + C_ev * (truth.omega_iv_v - omega_ie_v).cross(arm_v_m);
}

/// Errors of each receiver in NED at its antenna: [receiver][quantity: position m, velocity m/s][axis] a series.
class ErrorSink : public sim::RunSink {
 public:
  using Series = std::array<std::array<std::vector<double>, 3>, 2>;

  explicit ErrorSink(std::size_t receivers) : errors(receivers) {}

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState& truth) override { truth_ = truth; }
  void imu(std::size_t, const ImuSample&, const ImuTruth&) override {}
  void gnss(std::size_t index, const GnssFix& fix) override {
    const Matrix3 C_ne = C_en_at(geodetic_of(fix)).transpose();
    const Vector3 position_ned_m =
        C_ne * (nav::ecef_from_geodetic(geodetic_of(fix)) - point_e_m(truth_, kAntennaArm_v_m));
    const Vector3 velocity_n_m_per_s = fix.v_n - C_ne * point_v_e_m_per_s(truth_, kAntennaArm_v_m);
    for (int axis = 0; axis < 3; ++axis) {
      errors[index][0][axis].push_back(position_ned_m[axis]);
      errors[index][1][axis].push_back(velocity_n_m_per_s[axis]);
    }
  }
  void ack(const ProfileAck&) override {}

  std::vector<Series> errors;

 private:
  TruthState truth_;
};

/// One run of a car on a circle with these receivers.
std::vector<ErrorSink::Series> errors_of_run(const std::vector<GnssErrorProfile>& receivers, std::uint64_t seed,
                                             const Simulation& simulation) {
  scenario::LoadedScenario loaded = turning(kCircling_s, kRate_hz, {constant_rate(scenario::Axis::Z, 6.0)});
  loaded.scenario.seed = seed;
  for (const GnssErrorProfile& errors : receivers) {
    loaded.gnss.push_back(receiver(static_cast<std::uint32_t>(loaded.gnss.size()), kRate_hz, errors));
  }
  ErrorSink sink(receivers.size());
  simulation(loaded, kStart, sink);
  return sink.errors;
}

double mean_product(const std::vector<double>& series, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t k = lag; k < series.size(); ++k) sum += series[k] * series[k - lag];
  return sum / static_cast<double>(series.size() - lag);
}

/// Estimates of the mean square over the set variance: one for an axis of a seed.
struct SigmaRow {
  const char* quantity;
  double set;
  const char* unit;
  const char* published;  ///< the seed document's own
  Estimates ratios;
};

/// Standard error of mean_product(series, lag) over the variance for one series of errors with the correlation rho: of
/// a Gaussian process cov(x_k x_(k-l), x_(k+j) x_(k+j-l)) = sigma^4 (rho_j^2 + rho_(j+l) rho_(j-l)).
template <class Correlation>
double standard_error_of_product(std::size_t lag, const Correlation& rho) {
  const auto samples = static_cast<std::int64_t>(std::lround(kCircling_s * kRate_hz)) - static_cast<std::int64_t>(lag);
  const auto shift = static_cast<std::int64_t>(lag);
  double sum = 0.0;
  for (std::int64_t j = 1 - samples; j < samples; ++j) {
    const double weight = 1.0 - static_cast<double>(std::abs(j)) / static_cast<double>(samples);
    sum += weight * (rho(j) * rho(j) + rho(j + shift) * rho(j - shift));
  }
  return std::sqrt(sum / static_cast<double>(samples));
}

/// Half the width of the band that decides, and that is printed: by the estimator's own variance, not by the spread of
/// the estimates, which a fault could widen.
double half_band(const Estimates& estimates, double standard_error_of_one) {
  return kAllowedStandardErrors * standard_error_of_one / std::sqrt(static_cast<double>(estimates.count()));
}

bool within(const Estimates& estimates, double expected, double half_band) {
  return std::abs(estimates.mean() - expected) <= half_band;
}

/// sigma from the mean square: the root of the pooled ratio, with the band's ends likewise.
Row row_of(const SigmaRow& sigma, double band) {
  const double ratio = sigma.ratios.mean();
  const auto [low, high] = std::minmax_element(sigma.ratios.values().begin(), sigma.ratios.values().end());
  const auto shown = [&](double r) { return fmt::format("{:.5g}", sigma.set * std::sqrt(r)); };
  return {{fmt::format("{} {:g} {}", sigma.quantity, sigma.set, sigma.unit), shown(ratio),
           shown(ratio - band) + " .. " + shown(ratio + band), fmt::format("{:+.2f} %", 100 * (std::sqrt(ratio) - 1)),
           shown(*low) + " .. " + shown(*high), sigma.published},
          within(sigma.ratios, 1.0, band)};
}

}  // namespace

Table gnss_noise(std::uint64_t seeds, const Subjects& subjects) {
  std::vector<SigmaRow> rows;
  for (const double sigma : kPositionGradesM) rows.push_back({"position", sigma, "m", "4 %", {}});
  for (const double sigma : kVelocityGradesMPerS) rows.push_back({"velocity", sigma, "m/s", "3 %", {}});
  std::vector<GnssErrorProfile> receivers(3);
  for (std::size_t grade = 0; grade < 3; ++grade) {
    receivers[grade].position_sigma_ned_m.setConstant(kPositionGradesM[grade]);
    receivers[grade].velocity_sigma_ned_m_per_s.setConstant(kVelocityGradesMPerS[grade]);
  }
  std::size_t epochs = 0, estimates = 0, outside = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto errors = errors_of_run(receivers, seed, subjects.simulation);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (const std::vector<double>& series : errors[row % 3][row / 3]) {
        const double ratio = mean_product(series, 0) / (rows[row].set * rows[row].set);
        rows[row].ratios.add(ratio);
        epochs = series.size();
        ++estimates;
        const auto degrees = static_cast<double>(epochs);
        const bool inside = ratio * degrees >= allan::chi_square_quantile(0.005, degrees) &&
                            ratio * degrees <= allan::chi_square_quantile(0.995, degrees);
        outside += inside ? 0 : 1;
      }
    }
  }
  Table table;
  table.title = "GNSS white errors (thesis tables 4-8, 4-9)";
  table.columns = {"set (1 sigma)", "measured", "band", "error", "single estimates", "thesis"};
  const double white = standard_error_of_product(0, [](std::int64_t j) { return j == 0 ? 1.0 : 0.0; });
  for (const SigmaRow& row : rows) table.rows.push_back(row_of(row, half_band(row.ratios, white)));
  const int limit = allowed_outside(static_cast<int>(estimates));
  table.rows.push_back({{fmt::format("outside 99 %, of {}", estimates), std::to_string(outside),
                         fmt::format("at most {}", limit), "", "", ""},
                        outside <= static_cast<std::size_t>(limit)});
  table.notes = {
      fmt::format("{} seeds, 20 min at 10 Hz ({} epochs), three axes; a car on a circle, the antenna on its arm. "
                  "Measured: the root of the pooled mean square of GnssFix minus the antenna's truth through ECEF.",
                  seeds, epochs),
      "A row holds when the set value lies in the band: 3.5 standard errors of so many samples. The last row holds "
      "when no more of "
      "them leave their 99 % chi-square interval than the mean number and 3.5 standard deviations."};
  return table;
}

Table gnss_gauss_markov(std::uint64_t seeds, const Subjects& subjects) {
  constexpr double kCorrelationTime_s = 10.0;
  constexpr std::size_t kLag = 100;
  std::vector<GnssErrorProfile> receivers(1);
  receivers[0].position_gm_sigma_ned_m.setConstant(1.0);
  receivers[0].position_gm_correlation_time_s.setConstant(kCorrelationTime_s);
  receivers[0].velocity_gm_sigma_ned_m_per_s.setConstant(0.1);
  receivers[0].velocity_gm_correlation_time_s.setConstant(kCorrelationTime_s);
  std::array<SigmaRow, 2> sigmas{{{"position", 1.0, "m", "-", {}}, {"velocity", 0.1, "m/s", "-", {}}}};
  std::array<Estimates, 2> at_lag;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto errors = errors_of_run(receivers, seed, subjects.simulation);
    for (std::size_t quantity = 0; quantity < 2; ++quantity) {
      const double variance = sigmas[quantity].set * sigmas[quantity].set;
      for (const std::vector<double>& series : errors[0][quantity]) {
        sigmas[quantity].ratios.add(mean_product(series, 0) / variance);
        at_lag[quantity].add(mean_product(series, kLag) / variance);
      }
    }
  }
  Table table;
  const auto rho = [](std::int64_t j) {
    return std::exp(-static_cast<double>(std::abs(j)) / (kRate_hz * kCorrelationTime_s));
  };
  table.title = "GNSS Gauss-Markov errors, correlation time 10 s (not in the thesis)";
  table.columns = {"set (1 sigma)", "measured", "band", "error", "single estimates", "thesis"};
  for (std::size_t quantity = 0; quantity < 2; ++quantity) {
    table.rows.push_back(
        row_of(sigmas[quantity], half_band(sigmas[quantity].ratios, standard_error_of_product(0, rho))));
    const Estimates& estimates = at_lag[quantity];
    const double band = half_band(estimates, standard_error_of_product(kLag, rho));
    const double expected = std::exp(-1.0);
    table.rows.push_back({{fmt::format("{}: correlation after 10 s {:.4f}", sigmas[quantity].quantity, expected),
                           fmt::format("{:.4f}", estimates.mean()),
                           fmt::format("{:.4f} .. {:.4f}", estimates.mean() - band, estimates.mean() + band),
                           fmt::format("{:+.2f} %", 100 * (estimates.mean() / expected - 1)), "", "-"},
                          within(estimates, expected, band)});
  }
  return table;
}

namespace {

/// Fixes of a perfect receiver beside both truths.
class ArmSink : public sim::RunSink {
 public:
  struct Epoch {
    TruthState vehicle;
    ImuTruth imu;
    GnssFix fix;
  };

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState& truth) override { truth_ = truth; }
  void imu(std::size_t, const ImuSample&, const ImuTruth& truth) override { imu_ = truth; }
  void gnss(std::size_t, const GnssFix& fix) override { epochs.push_back({truth_, imu_, fix}); }
  void ack(const ProfileAck&) override {}

  std::vector<Epoch> epochs;

 private:
  TruthState truth_;
  ImuTruth imu_;
};

/// Two minutes at 50 Hz, the arms apart, no errors.
std::vector<ArmSink::Epoch> tumbling(double rate_hz, const Simulation& simulation) {
  scenario::LoadedScenario loaded =
      turning(120.0, rate_hz,
              {swinging_rate(scenario::Axis::X, 40.0, 13.0), swinging_rate(scenario::Axis::Y, 40.0, 11.0),
               constant_rate(scenario::Axis::Z, 20.0)});
  loaded.gnss.push_back(receiver(0, rate_hz, GnssErrorProfile{}));
  scenario::LoadedImu imu;
  imu.rate = time::Rate(rate_hz);
  imu.installation.lever_arm_v_m = kImuArm_v_m;
  loaded.imus.push_back(imu);
  ArmSink sink;
  simulation(loaded, kStart, sink);
  return sink.epochs;
}

}  // namespace

Table gnss_lever_arm(const Subjects& subjects) {
  constexpr double kArmRate_hz = 50.0;
  constexpr double kLimit = 1e-6;
  const std::vector<ArmSink::Epoch> epochs = tumbling(kArmRate_hz, subjects.simulation);
  const auto antenna_e_m = [&epochs](std::size_t k) { return nav::ecef_from_geodetic(geodetic_of(epochs[k].fix)); };
  double arm_error_m = 0.0, velocity_error_m_per_s = 0.0, widest_pitch = 0.0;
  for (std::size_t k = 2; k + 2 < epochs.size(); ++k) {
    const auto& [vehicle, imu, fix] = epochs[k];
    const Matrix3 C_nv = vehicle.q_nv.toRotationMatrix();
    const Matrix3 C_ne = C_en_at(geodetic_of(vehicle)).transpose();
    const Vector3 imu_e_m = nav::ecef_from_geodetic(geodetic_of(imu));
    const Vector3 apart_n_m = C_ne * (antenna_e_m(k) - imu_e_m);
    arm_error_m = std::max(arm_error_m, (apart_n_m - C_nv * (kAntennaArm_v_m - kImuArm_v_m)).norm());

    const Vector3 derivative_e =
        (8.0 * (antenna_e_m(k + 1) - antenna_e_m(k - 1)) - (antenna_e_m(k + 2) - antenna_e_m(k - 2))) *
        (kArmRate_hz / 12.0);
    const Vector3 reported_e = C_en_at(geodetic_of(fix)) * fix.v_n;
    velocity_error_m_per_s = std::max(velocity_error_m_per_s, (C_ne * (reported_e - derivative_e)).norm());
    widest_pitch = std::max(widest_pitch, std::abs(C_nv(2, 0)));
  }
  Table table;
  table.title = "Lever arm of the antenna in any attitude";
  table.columns = {"over 2 min of tumbling at 10 m/s", "largest", "limit"};
  table.rows = {{{"antenna minus IMU, from the rotated arm", fmt::format("{:.1e} m", arm_error_m),
                  fmt::format("{:.0e} m", kLimit)},
                 arm_error_m <= kLimit},
                {{"velocity, from the five-point derivative", fmt::format("{:.1e} m/s", velocity_error_m_per_s),
                  fmt::format("{:.0e} m/s", kLimit)},
                 velocity_error_m_per_s <= kLimit}};
  table.notes = {fmt::format(
      "{} attitudes, rolling and pitching with two periods while the heading goes round, the nose up to {:.1f} deg "
      "from "
      "level. Position of the IMU: its published truth. The derivative is taken in ECEF over 20 ms and turned into the "
      "vehicle's NED; at rates w of up to 1.05 rad/s it is good to v w^4 h^4/30 = 7e-8 m/s for the path and, by the "
      "rounding of positions, to 1e-7 m/s.",
      epochs.size(), std::asin(std::min(1.0, widest_pitch)) / units::kDeg)};
  return table;
}

std::vector<Table> gnss(bool full) {
  const std::uint64_t seeds = full ? 200 : 20;
  return {gnss_noise(seeds), gnss_gauss_markov(seeds), gnss_lever_arm()};
}

}  // namespace inslab::verify
