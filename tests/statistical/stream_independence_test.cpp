#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/scenario/load.hpp"

/// No two axes, terms, sensors or units share random numbers: read off the output of the models, one term on at a time,
/// which is fair since another term changes no draw (tested below).
///
/// Bound: for independent series the correlation r = sum(a b)/sqrt(sum(a^2) sum(b^2)) of n samples has the variance
/// (1 + 2 sum_i rho_a(i) rho_b(i))/n. White series have no autocorrelation rho; of what wanders the first differences
/// are taken, where rho(1) of both is -1/2 at the most and the variance 1.5/n. With m correlations tested,
/// |r| <= z sqrt(1.5/n) for all of them with probability 0.999 when erfc(z/sqrt(2)) = 0.001/m. Two series that share
/// numbers, at the same index or at neighbours', have |r| of 1/2 or more.
namespace inslab::statistical {
namespace stream_independence_test {

struct Series {
  std::string name;
  std::vector<double> values;
};

constexpr std::int64_t kSamples = 2048;
constexpr double kPeriod_s = 1.0;

/// Correlation time so short that a Gauss-Markov process is its drive alone: exp(-dt/T) = 4e-22.
constexpr double kShort_s = kPeriod_s / 49.0;

std::uint64_t seed_of_unit(const std::string& unit) {
  scenario::LoadedScenario loaded;
  loaded.scenario.seed = 7;
  loaded.unit = unit;
  return loaded.stream_seed();
}

/// A vehicle whose increments never change, so that scale factors show; where it is does not follow them, nor matter.
TruthState steady(std::int64_t k) {
  TruthState truth;
  truth.dtheta_v.setConstant(k == 0 ? 0.0 : 0.1);
  truth.dv_v.setConstant(k == 0 ? 0.0 : 1.0);
  truth.header.sim_time_ns = k * 1'000'000'000;
  truth.interval_ns = k == 0 ? 0 : 1'000'000'000;
  return truth;
}

struct ImuTerm {
  const char* name;
  void (*set)(ImuErrorProfile&);
  bool wanders = false;  ///< its first differences are taken
};

const ImuTerm kImuTerms[] = {{"white",
                              [](ImuErrorProfile& p) {
                                p.gyro.arw_deg_per_sqrt_h.setConstant(1.0);
                                p.accel.vrw_m_per_s_per_sqrt_h.setConstant(1.0);
                              }},
                             {"bias_gm",
                              [](ImuErrorProfile& p) {
                                p.gyro.bias_gm_sigma_deg_per_h.setConstant(1.0);
                                p.gyro.bias_gm_correlation_time_s.setConstant(kShort_s);
                                p.accel.bias_gm_sigma_mgal.setConstant(1.0);
                                p.accel.bias_gm_correlation_time_s.setConstant(kShort_s);
                              }},
                             {"bias_random_walk",
                              [](ImuErrorProfile& p) {
                                p.gyro.bias_random_walk_deg_per_h_per_sqrt_h.setConstant(1.0);
                                p.accel.bias_random_walk_mgal_per_sqrt_h.setConstant(1.0);
                              },
                              true},
                             {"bias_instability",
                              [](ImuErrorProfile& p) {
                                p.gyro.bias_instability_deg_per_h.setConstant(1.0);
                                p.accel.bias_instability_mgal.setConstant(1.0);
                              },
                              true},
                             {"scale_factor_gm", [](ImuErrorProfile& p) {
                                p.gyro.scale_factor_gm_sigma_ppm.setConstant(1.0);
                                p.gyro.scale_factor_gm_correlation_time_s.setConstant(kShort_s);
                                p.accel.scale_factor_gm_sigma_ppm.setConstant(1.0);
                                p.accel.scale_factor_gm_correlation_time_s.setConstant(kShort_s);
                              }}};

const ImuTerm kConstants[] = {{"bias_turn_on",
                               [](ImuErrorProfile& p) {
                                 p.gyro.bias_turn_on_sigma_deg_per_h.setConstant(1.0);
                                 p.accel.bias_turn_on_sigma_mgal.setConstant(1.0);
                               }},
                              {"scale_factor_turn_on", [](ImuErrorProfile& p) {
                                 p.gyro.scale_factor_turn_on_sigma_ppm.setConstant(1.0);
                                 p.accel.scale_factor_turn_on_sigma_ppm.setConstant(1.0);
                               }}};

/// Errors of an IMU with the given terms: three gyros, three accelerometers.
std::array<std::vector<double>, 6> imu_errors(std::uint64_t seed, std::uint32_t number,
                                              const std::vector<ImuTerm>& terms, std::int64_t samples) {
  ImuErrorProfile errors;
  errors.target = {SensorKind::Imu, number};
  for (const ImuTerm& term : terms) term.set(errors);
  imu::ImuModel model({seed, number, time::Rate(1.0), nav::Gravity(), errors, {}, {}});
  std::array<std::vector<double>, 6> output;
  for (std::int64_t k = 0; k <= samples; ++k) {
    const auto measured = model.measure(steady(k));
    if (!measured) continue;
    for (int axis = 0; axis < 3; ++axis) {
      output[axis].push_back(measured->sample.dtheta_b[axis] - measured->truth.dtheta_b[axis]);
      output[3 + axis].push_back(measured->sample.dv_b[axis] - measured->truth.dv_b[axis]);
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
std::array<std::vector<double>, 6> gnss_errors(std::uint64_t seed, std::uint32_t number,
                                               const std::vector<GnssTerm>& terms, std::int64_t epochs) {
  gnss::GnssModel::Setup setup{seed, number, time::Rate(1.0), {}, {}, {}, {}};
  setup.errors.target = setup.installation.target = {SensorKind::Gnss, number};
  for (const GnssTerm& term : terms) term.set(setup.errors);
  gnss::GnssModel model(setup);
  std::array<std::vector<double>, 6> output;
  for (std::int64_t k = 1; k <= epochs; ++k) {
    const auto fix = model.observe(steady(k));
    const Vector3 position = nav::ned_from({}, geodetic_of(*fix));
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

std::array<std::vector<double>, 6> differences(const std::array<std::vector<double>, 6>& six) {
  std::array<std::vector<double>, 6> changes;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    for (std::size_t k = 1; k < six[axis].size(); ++k) changes[axis].push_back(six[axis][k] - six[axis][k - 1]);
  }
  return changes;
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
  const double bound = bound_in_standard_errors(3 * pairs) * std::sqrt(1.5 / static_cast<double>(n));
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
        const auto errors = imu_errors(seed, number, {term}, term.wanders ? kSamples + 1 : kSamples);
        append(all, sensor + "imu " + term.name, term.wanders ? differences(errors) : errors);
      }
      for (const GnssTerm& term : kGnssTerms) {
        append(all, sensor + "gnss " + term.name, gnss_errors(seed, number, {term}, kSamples));
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
      for (const ImuTerm& term : kConstants) {
        std::array<std::vector<double>, 6> constants;
        for (std::uint64_t scenario_seed = 1; scenario_seed <= 2000; ++scenario_seed) {
          scenario::LoadedScenario loaded;
          loaded.scenario.seed = scenario_seed;
          loaded.unit = unit;
          const auto errors = imu_errors(loaded.stream_seed(), number, {term}, 1);
          for (std::size_t axis = 0; axis < 6; ++axis) constants[axis].push_back(errors[axis].front());
        }
        append(all, unit + " imu" + std::to_string(number) + " " + term.name, std::move(constants));
      }
    }
  }
  expect_all_uncorrelated(all);
}

TEST(StreamIndependence, ATermMoreChangesNoDrawOfTheOthers) {
  // With all terms the error is the sum of the errors with each. Rounding: an IMU's increments are of the size 1, so
  // every error read off them is good to 1e-16 and its largest sums to a few of these; the angles of a position are
  // good to 1.4e-9 m.
  std::array<std::vector<double>, 6> imu_sum = imu_errors(7, 0, {}, 200), gnss_sum = gnss_errors(7, 0, {}, 200);
  const auto add = [](std::array<std::vector<double>, 6>& sum, const std::array<std::vector<double>, 6>& more) {
    for (std::size_t axis = 0; axis < 6; ++axis) {
      for (std::size_t k = 0; k < sum[axis].size(); ++k) sum[axis][k] += more[axis][k];
    }
  };
  for (const ImuTerm& term : kImuTerms) add(imu_sum, imu_errors(7, 0, {term}, 200));
  for (const GnssTerm& term : kGnssTerms) add(gnss_sum, gnss_errors(7, 0, {term}, 200));
  const auto imu_all = imu_errors(7, 0, {std::begin(kImuTerms), std::end(kImuTerms)}, 200);
  const auto gnss_all = gnss_errors(7, 0, {std::begin(kGnssTerms), std::end(kGnssTerms)}, 200);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    for (std::size_t k = 0; k < 200; ++k) {
      ASSERT_NEAR(imu_all[axis][k], imu_sum[axis][k], 2e-15) << axis << ' ' << k;
      ASSERT_NEAR(gnss_all[axis][k], gnss_sum[axis][k], 1e-8) << axis << ' ' << k;
    }
  }
}

TEST(StreamIndependence, AUnitWithoutANameHasTheScenariosSeedAndOthersTheirOwn) {
  EXPECT_EQ(seed_of_unit(""), 7U);
  EXPECT_NE(seed_of_unit("alpha"), 7U);
  EXPECT_NE(seed_of_unit("alpha"), seed_of_unit("beta"));
  EXPECT_EQ(seed_of_unit("alpha"), seed_of_unit("alpha"));
}

}  // namespace stream_independence_test
}  // namespace inslab::statistical
