#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nav/geodesy.hpp"
#include "scenario/load.hpp"
#include "services/gnss_emulator/model.hpp"
#include "services/imu_error_injector/model.hpp"

/// No two axes, terms, sensors or units share random numbers: read off the output of the models, one term on at a time,
/// which is fair since another term changes no draw (tested below).
///
/// Bound: for independent series the correlation r = sum(a b)/sqrt(sum(a^2) sum(b^2)) of n samples has the standard
/// error 1/sqrt(n). With m correlations tested, |r| <= z/sqrt(n) for all of them with probability 0.999 when
/// erfc(z/sqrt(2)) = 0.001/m. Two series that share numbers, at the same index or at neighbours', have r = 1.
namespace inslab {
namespace {

struct Series {
  std::string name;
  std::vector<double> values;
};

constexpr std::int64_t kSamples = 4096;
constexpr double kPeriod_s = 1.0;

/// Correlation time so short that a Gauss-Markov process is its drive alone: exp(-dt/T) = 4e-22.
constexpr double kShort_s = kPeriod_s / 49.0;

std::uint64_t seed_of_unit(const std::string& unit) {
  scenario::LoadedScenario loaded;
  loaded.scenario.seed = 7;
  loaded.unit = unit;
  return loaded.stream_seed();
}

/// A perfect vehicle that does not even feel the Earth: all output of an IMU is error.
TruthState nothing(std::int64_t k) {
  TruthState truth;
  truth.header.sim_time_ns = k * 1'000'000'000;
  truth.interval_ns = k == 0 ? 0 : 1'000'000'000;
  return truth;
}

struct ImuTerm {
  const char* name;
  void (*set)(ImuErrorProfile&);
};

const ImuTerm kImuTerms[] = {{"white",
                              [](ImuErrorProfile& p) {
                                p.gyro.arw_deg_per_sqrt_h.setConstant(1.0);
                                p.accel.vrw_m_per_s_per_sqrt_h.setConstant(1.0);
                              }},
                             {"bias_gm", [](ImuErrorProfile& p) {
                                p.gyro.bias_gm_sigma_deg_per_h.setConstant(1.0);
                                p.gyro.bias_gm_correlation_time_s.setConstant(kShort_s);
                                p.accel.bias_gm_sigma_mgal.setConstant(1.0);
                                p.accel.bias_gm_correlation_time_s.setConstant(kShort_s);
                              }}};

const ImuTerm kTurnOn = {"bias_turn_on", [](ImuErrorProfile& p) {
                           p.gyro.bias_turn_on_sigma_deg_per_h.setConstant(1.0);
                           p.accel.bias_turn_on_sigma_mgal.setConstant(1.0);
                         }};

/// Output of an IMU with the given terms: three gyros, three accelerometers.
std::array<std::vector<double>, 6> imu_output(std::uint64_t seed, std::uint32_t number,
                                              const std::vector<ImuTerm>& terms, std::int64_t samples) {
  ImuErrorProfile errors;
  errors.target = {SensorKind::Imu, number};
  for (const ImuTerm& term : terms) term.set(errors);
  imu::ImuModel model({seed, number, time::Rate(1.0), time::Rate(1.0), nav::Gravity(), errors, {}, {}});
  std::array<std::vector<double>, 6> output;
  for (std::int64_t k = 0; k <= samples; ++k) {
    const auto measured = model.measure(nothing(k));
    if (!measured) continue;
    for (int axis = 0; axis < 3; ++axis) {
      output[axis].push_back(measured->sample.dtheta_b[axis]);
      output[3 + axis].push_back(measured->sample.dv_b[axis]);
    }
  }
  return output;
}

struct GnssTerm {
  const char* name;
  void (*set)(GnssErrorProfile&);
};

const GnssTerm kGnssTerms[] = {{"white",
                                [](GnssErrorProfile& p) {
                                  p.position_sigma_ned_m.setConstant(1.0);
                                  p.velocity_sigma_ned_m_per_s.setConstant(1.0);
                                }},
                               {"gm", [](GnssErrorProfile& p) {
                                  p.position_gm_sigma_ned_m.setConstant(1.0);
                                  p.position_gm_correlation_time_s.setConstant(kShort_s);
                                  p.velocity_gm_sigma_ned_m_per_s.setConstant(1.0);
                                  p.velocity_gm_correlation_time_s.setConstant(kShort_s);
                                }}};

/// Errors of a receiver with the given terms: position north, east, down, velocity likewise.
std::array<std::vector<double>, 6> gnss_output(std::uint64_t seed, std::uint32_t number,
                                               const std::vector<GnssTerm>& terms, std::int64_t epochs) {
  gnss::GnssModel::Setup setup{seed, number, time::Rate(1.0), time::Rate(1.0), {}, {}, {}, {}};
  setup.errors.target = setup.installation.target = {SensorKind::Gnss, number};
  for (const GnssTerm& term : terms) term.set(setup.errors);
  gnss::GnssModel model(setup);
  std::array<std::vector<double>, 6> output;
  for (std::int64_t k = 1; k <= epochs; ++k) {
    const auto fix = model.observe(nothing(k));
    const Vector3 position = nav::ned_from({}, {fix->latitude_rad, fix->longitude_rad, fix->height_m});
    for (int axis = 0; axis < 3; ++axis) {
      output[axis].push_back(position[axis]);
      output[3 + axis].push_back(fix->v_n[axis]);
    }
  }
  return output;
}

void append(std::vector<Series>& all, const std::string& name, std::array<std::vector<double>, 6> six) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    all.push_back({name + " axis " + std::to_string(axis), std::move(six[axis])});
  }
}

void normalise(std::vector<double>& values) {
  double square = 0.0;
  for (const double v : values) square += v * v;
  for (double& v : values) v /= std::sqrt(square);
}

/// z with erfc(z/sqrt(2)) = 0.001/tests, by bisection.
double bound_in_standard_errors(std::size_t tests) {
  double low = 0.0, high = 10.0;
  while (high - low > 1e-6) {
    const double z = 0.5 * (low + high);
    (std::erfc(z / std::sqrt(2.0)) > 1e-3 / static_cast<double>(tests) ? low : high) = z;
  }
  return high;
}

/// All pairs, and each at its neighbours' indices too: processes number their draws from different indices on.
void expect_all_uncorrelated(std::vector<Series>& all) {
  for (Series& series : all) normalise(series.values);
  const std::size_t n = all.front().values.size();
  const std::size_t pairs = all.size() * (all.size() - 1) / 2;
  const double bound = bound_in_standard_errors(3 * pairs) / std::sqrt(static_cast<double>(n));
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const std::vector<double>&x = all[a].values, &y = all[b].values;
      double before = 0.0, at = 0.0, after = 0.0;
      for (std::size_t k = 1; k + 1 < n; ++k) {
        before += x[k] * y[k - 1];
        at += x[k] * y[k];
        after += x[k] * y[k + 1];
      }
      for (const double r : {before, at, after}) {
        ASSERT_LT(std::abs(r), bound) << all[a].name << " and " << all[b].name;
      }
    }
  }
}

TEST(StreamIndependence, NoTwoAxesTermsSensorsOrUnitsAreCorrelated) {
  std::vector<Series> all;
  for (const std::string unit : {"", "alpha", "beta"}) {
    const std::uint64_t seed = seed_of_unit(unit);
    for (const std::uint32_t number : {0U, 1U}) {
      const std::string sensor = unit + " sensor " + std::to_string(number) + " ";
      for (const ImuTerm& term : kImuTerms) {
        append(all, sensor + "imu " + term.name, imu_output(seed, number, {term}, kSamples));
      }
      for (const GnssTerm& term : kGnssTerms) {
        append(all, sensor + "gnss " + term.name, gnss_output(seed, number, {term}, kSamples));
      }
    }
  }
  ASSERT_EQ(all.size(), 3U * 2U * 6U * (std::size(kImuTerms) + std::size(kGnssTerms)));
  expect_all_uncorrelated(all);
}

TEST(StreamIndependence, NoTwoTurnOnConstantsAreCorrelatedOverTheSeeds) {
  // One number a run: series over 2000 scenario seeds, for a unit without a name and one with.
  std::vector<Series> all;
  for (const std::string unit : {"", "alpha"}) {
    for (const std::uint32_t number : {0U, 1U}) {
      std::array<std::vector<double>, 6> constants;
      for (std::uint64_t scenario_seed = 1; scenario_seed <= 2000; ++scenario_seed) {
        scenario::LoadedScenario loaded;
        loaded.scenario.seed = scenario_seed;
        loaded.unit = unit;
        const auto output = imu_output(loaded.stream_seed(), number, {kTurnOn}, 1);
        for (std::size_t axis = 0; axis < 6; ++axis) constants[axis].push_back(output[axis].front());
      }
      append(all, unit + " imu" + std::to_string(number) + " turn-on", std::move(constants));
    }
  }
  expect_all_uncorrelated(all);
}

TEST(StreamIndependence, ATermMoreChangesNoDrawOfTheOthers) {
  // With both terms the output is the sum of the outputs with each: to the rounding of one addition for an IMU, of the
  // angles (1.4e-9 m) for a position of at most 10 m.
  const auto imu_white = imu_output(7, 0, {kImuTerms[0]}, 200), imu_gm = imu_output(7, 0, {kImuTerms[1]}, 200);
  const auto imu_both = imu_output(7, 0, {kImuTerms[0], kImuTerms[1]}, 200);
  const auto gnss_white = gnss_output(7, 0, {kGnssTerms[0]}, 200), gnss_gm = gnss_output(7, 0, {kGnssTerms[1]}, 200);
  const auto gnss_both = gnss_output(7, 0, {kGnssTerms[0], kGnssTerms[1]}, 200);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    for (std::size_t k = 0; k < 200; ++k) {
      const double imu_sum = imu_white[axis][k] + imu_gm[axis][k];
      ASSERT_NEAR(imu_both[axis][k], imu_sum, 1e-15 * (1.0 + std::abs(imu_sum))) << axis << ' ' << k;
      ASSERT_NEAR(gnss_both[axis][k], gnss_white[axis][k] + gnss_gm[axis][k], 1e-8) << axis << ' ' << k;
    }
  }
}

TEST(StreamIndependence, AUnitWithoutANameHasTheScenariosSeedAndOthersTheirOwn) {
  EXPECT_EQ(seed_of_unit(""), 7U);
  EXPECT_NE(seed_of_unit("alpha"), 7U);
  EXPECT_NE(seed_of_unit("alpha"), seed_of_unit("beta"));
  EXPECT_EQ(seed_of_unit("alpha"), seed_of_unit("alpha"));
}

}  // namespace
}  // namespace inslab
