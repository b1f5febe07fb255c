// From every profile of config/profiles/imu to a record and by the fit of `inslab allan` back to the profile: its 99 %
// intervals hold what the profile says as often as they promise.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/noise/allan/confidence.hpp"
#include "inslab/noise/allan/fit.hpp"
#include "inslab/noise/allan/record.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::statistical {
namespace allan_round_trip_test {

constexpr double kRate_hz = 10.0;
constexpr double kSpan_s = 4.0 * 3600.0;
constexpr std::size_t kClusters = 1024;
constexpr double kConfidence = 0.99;
/// 20 take twelve minutes of one core (docs/allan.md has what came out); every day fewer.
constexpr std::uint64_t kSeedsOfEveryDay = 1;

std::uint64_t seeds() {
  const char* asked = std::getenv("INSLAB_ROUND_TRIP_SEEDS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : kSeedsOfEveryDay;
}

/// What the random terms of an axis are in SI; what is drawn once is no noise of a record.
allan::NoiseModel set_by(const ImuErrorProfile& profile, int axis) {
  allan::NoiseModel model;
  if (axis < 3) {
    const GyroErrors& g = profile.gyro;
    model.white = units::kDegPerSqrtH * g.arw_deg_per_sqrt_h[axis];
    model.quantization = units::kArcsec * g.quantization_arcsec[axis] / std::sqrt(12.0);
    model.flicker = units::kDegPerH * g.bias_instability_deg_per_h[axis];
    model.random_walk = units::kDegPerHPerSqrtH * g.bias_random_walk_deg_per_h_per_sqrt_h[axis];
    model.gm_sigma = units::kDegPerH * g.bias_gm_sigma_deg_per_h[axis];
    model.gm_correlation_time_s = g.bias_gm_correlation_time_s[axis];
  } else {
    const AccelErrors& a = profile.accel;
    model.white = units::kMPerSPerSqrtH * a.vrw_m_per_s_per_sqrt_h[axis - 3];
    model.quantization = a.quantization_m_per_s[axis - 3] / std::sqrt(12.0);
    model.flicker = units::kMGal * a.bias_instability_mgal[axis - 3];
    model.random_walk = units::kMGalPerSqrtH * a.bias_random_walk_mgal_per_sqrt_h[axis - 3];
    model.gm_sigma = units::kMGal * a.bias_gm_sigma_mgal[axis - 3];
    model.gm_correlation_time_s = a.bias_gm_correlation_time_s[axis - 3];
  }
  return model;
}

std::vector<allan::Term> terms_of(const allan::NoiseModel& model) {
  std::vector<allan::Term> terms;
  if (model.white > 0.0) terms.push_back(allan::Term::White);
  if (model.quantization > 0.0) terms.push_back(allan::Term::Quantization);
  if (model.flicker > 0.0) terms.push_back(allan::Term::Flicker);
  if (model.random_walk > 0.0) terms.push_back(allan::Term::RandomWalk);
  if (model.gm_sigma > 0.0) terms.push_back(allan::Term::GaussMarkov);
  return terms;
}

/// An IMU in a chamber of constant temperature that loses no sample and does not even feel the Earth: all of its output
/// is error.
std::vector<allan::Record> recorded(ImuErrorProfile errors, std::uint64_t seed) {
  errors.temperature.clear();
  errors.drop_probability = 0.0;
  const time::Rate rate(kRate_hz);
  imu::ImuModel model({seed, 0, rate, nav::Gravity(), errors, {}, {}});
  std::vector<allan::Record> records(6, allan::Record(rate.period_s(), kClusters));
  const std::int64_t period_ns = rate.period().count();
  const auto samples = static_cast<std::int64_t>(kSpan_s * kRate_hz);
  for (std::int64_t k = 0; k <= samples; ++k) {
    TruthState truth;
    truth.header.sim_time_ns = k * period_ns;
    truth.interval_ns = k == 0 ? 0 : period_ns;
    const auto output = model.measure(truth);
    if (!output) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      records[axis].add(output->sample.dtheta_b[i]);
      records[axis + 3].add(output->sample.dv_b[i]);
    }
  }
  return records;
}

struct Tally {
  int intervals = 0;
  int misses = 0;
};

void judge(const allan::Record& record, const allan::NoiseModel& set, Tally& tally) {
  const std::vector<allan::Term> terms = terms_of(set);
  if (terms.empty()) return;
  const allan::Likelihood likelihood(record);
  const auto log = [&likelihood](const allan::NoiseModel& model) { return likelihood.log(model); };
  const allan::Fit fit = allan::fit(likelihood, terms);
  const double limit = 0.5 * allan::chi_square_quantile(kConfidence, 1.0);
  for (const allan::Term term : terms) {
    for (const allan::Parameter parameter : allan::parameters_of(term)) {
      ++tally.intervals;
      tally.misses += allan::drop_at(log, fit, parameter, allan::value_of(set, parameter)) > limit ? 1 : 0;
    }
  }
}

// Of n intervals one in a hundred misses; of counts of misses, binomial, one in 4000 is beyond 3.5 standard deviations.
TEST(AllanRoundTrip, IntervalsHoldWhatEveryProfileSaysAsOftenAsTheyPromise) {
  Tally all;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(INSLAB_SOURCE_DIR) / "config/profiles/imu")) {
    if (entry.path().extension() != ".json") continue;
    const catalog::AnyProfile any = scenario::load_profile(entry.path(), ProfileKind::ImuError, {SensorKind::Imu, 0});
    const auto& profile = std::get<ImuErrorProfile>(any);
    Tally of_profile;
    for (std::uint64_t seed = 1; seed <= seeds(); ++seed) {
      const std::vector<allan::Record> records = recorded(profile, seed);
      for (int axis = 0; axis < 6; ++axis)
        judge(records[static_cast<std::size_t>(axis)], set_by(profile, axis), of_profile);
    }
    std::printf("%-20s %4d of %5d intervals miss\n", profile.name.c_str(), of_profile.misses, of_profile.intervals);
    all.intervals += of_profile.intervals;
    all.misses += of_profile.misses;
  }
  const double expected = (1.0 - kConfidence) * all.intervals;
  EXPECT_GT(all.intervals, 0);
  EXPECT_LE(all.misses, expected + 3.5 * std::sqrt(kConfidence * expected));
  std::printf("all: %d of %d, expected %.1f\n", all.misses, all.intervals, expected);
}

}  // namespace allan_round_trip_test
}  // namespace inslab::statistical
