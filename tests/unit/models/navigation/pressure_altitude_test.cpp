#include "inslab/models/navigation/pressure_altitude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "inslab/models/navigation/matching_barometer.hpp"
#include "tests/unit/models/navigation/drawn_run.hpp"

namespace inslab::navigation {
namespace pressure_altitude_test {

using namespace circling;
namespace air = nav::standard_atmosphere;

/// What the air of a day is, and how the port errs.
struct Day {
  double sea_level_pa = 101325.0;
  double deviation_k = 0.0;
  double static_pressure = 0.0;
};

AirPressure shown(double height_m, double speed_m_per_s, const Day& day) {
  AirPressure sample;
  const air::Air there = air::air_at(air::geopotential_height_m(height_m), day.sea_level_pa, day.deviation_k);
  sample.pressure_pa =
      there.pressure_pa + day.static_pressure * 0.5 * there.density_kg_per_m3() * speed_m_per_s * speed_m_per_s;
  sample.pressure_altitude_m = air::pressure_altitude_m(sample.pressure_pa);
  return sample;
}

AirPressure shown_at(const Circling& truth, const Day& day) {
  AirPressure sample = shown(truth.state().position.height_m, truth.state().v_n.norm(), day);
  sample.header.sim_time_ns = truth.time_ns();
  return sample;
}

NavigationParameters told() {
  NavigationParameters p;
  p.states.pressure_bias = p.states.pressure_slope = true;
  p.barometer.white_sigma_pa = 2.0;
  return p;
}

double innovation_m(const AirPressure& sample, const Situation& at, const NavigationParameters& p) {
  std::vector<Measurement> made;
  PressureAltitude::add_to(made, sample, at, p);
  return made.front().innovation[0];
}

// Central differences of step h err by h^2/6 of the third derivative: 10 m of arm turned by 1e-4 rad, some 1e-8 m/rad.
// A place is displaced to the bit of its height, 1e-13 m of 1e3 m, over a step of 1 m.
TEST(PressureAltitude, ItsDerivativesAreThoseOfWhatItPredicts) {
  NavigationParameters p = told();
  p.barometer.lever_arm_b_m = Vector3(8.0, -3.0, 5.0);
  p.barometer.lag_s = 0.3;
  const StateLayout layout(p.states);
  Situation at;
  at.position = {0.8, 0.2, 1300.0};
  at.v_n = Vector3(40.0, -20.0, -6.0);
  at.C_nb = nav::matrix_from_rpy({0.3, -0.4, 2.0});
  at.omega_ib_b = Vector3(0.2, -0.3, 0.5);
  at.estimates[StateBlock::PressureBias] = Vector3(30.0, -2.0, 0.5);
  at.estimates[StateBlock::PressureSlope] = Vector3(0.02, -0.08, 0.0);
  AirPressure sample;
  sample.pressure_altitude_m = 1300.0;
  std::vector<Measurement> made;
  PressureAltitude::add_to(made, sample, at, p);
  const auto H = made.front().H(layout);
  for (Eigen::Index i = 0; i < layout.size(); ++i) {
    const double h = i < kVelocity ? 1.0 : 1e-4;
    StateVector x = StateVector::Zero(layout.size());
    x[i] = h;
    const double slope =
        (innovation_m(sample, erring(at, x, layout), p) - innovation_m(sample, erring(at, -x, layout), p)) / (2.0 * h);
    EXPECT_NEAR(slope, H(0, i), 1e-5) << "state " << i;
  }
}

// From 500 to 600 m at 10 and 30 m/s on a warm day of high pressure, with a port that errs: what the filter's sum of a
// bias, a scale and a share of v^2 / (2 g) leaves is of second order, 6 K over 288 K squared of the 100 m climbed, and
// the bias of 40 m by the lapse of temperature over it, 0.26 K / 285 K of 100 m: less than 0.15 m of 102 m.
TEST(PressureAltitude, PredictsWhatTheAirOfAnotherDayShows) {
  const Day day{101800.0, 6.0, -0.08};
  Situation low, high;
  low.position = {0.8, 0.2, 500.0};
  low.v_n = Vector3(10.0, 0.0, 0.0);
  high.position = {0.8, 0.2, 600.0};
  high.v_n = Vector3(0.0, 30.0, 0.0);
  for (Situation* at : {&low, &high}) at->estimates[StateBlock::PressureSlope] = Vector3(-6.0 / 285.0, -0.08, 0.0);
  const NavigationParameters p = told();
  const double before_m = innovation_m(shown(500.0, 10.0, day), low, p);
  const double after_m = innovation_m(shown(600.0, 30.0, day), high, p);
  EXPECT_NEAR(after_m, before_m, 0.15);
  Situation ignorant = high;
  ignorant.estimates[StateBlock::PressureSlope].setZero();
  EXPECT_GT(std::abs(innovation_m(shown(600.0, 30.0, day), ignorant, p) - before_m), 4.0);
}

// A port that shows 0.3 s late on a climb of 4 m/s shows 1.2 m too little.
TEST(PressureAltitude, KnowsTheLagOfThePort) {
  NavigationParameters p = told();
  Situation at;
  at.position = {0.8, 0.2, 500.0};
  at.v_n = Vector3(0.0, 0.0, -4.0);
  const double without_m = innovation_m({}, at, p);
  p.barometer.lag_s = 0.3;
  EXPECT_NEAR(innovation_m({}, at, p) - without_m, -1.2, 1e-12);
}

// When the fixes are gone an accelerometer errs by 0.002 m/s^2 more: 3.6 m in the 60 s to the end.
TEST(PressureAltitude, KeepsTheHeightOnceFixesHaveShownItsBias) {
  NavigationParameters p = told();
  p.barometer.bias_sigma_m = Vector3(100.0, 0.2, 0.0);
  const Day day{102000.0, 0.0, 0.0};
  Circling truth, twin;
  NavigationFilter aided = begun(truth, p), alone = begun(twin, p);
  for (int k = 0; k < 16000; ++k) {
    ImuSample sample = truth.next();
    if (k >= 4000) sample.dv_b.z() += kDt_s * 0.002;
    twin.next();
    aided.add(sample);
    alone.add(sample);
    if (k < 4000 && is_fix_time(truth)) {
      aided.add(truth.fix());
      alone.add(truth.fix());
    }
    if (k % 20 == 19) aided.add(shown_at(truth, day));
  }
  const double height_m = truth.state().position.height_m;
  EXPECT_LT(std::abs(aided.filter()->state().position.height_m - height_m), 0.3);
  EXPECT_GT(std::abs(alone.filter()->state().position.height_m - height_m), 3.0);
  // 675 Pa of 0.0824 m (288 K of 29.27 m/K over 101660 Pa).
  EXPECT_NEAR(aided.filter()->estimates()[StateBlock::PressureBias].sum(), -56.0, 1.0);
}

// A door that slams: 60 Pa are 5 m, of which 0.2 m of noise and a bias that is known by then know nothing.
TEST(PressureAltitude, WhatTheInnovationTestRefusesChangesNothing) {
  const NavigationParameters p = told();
  Circling truth, twin;
  NavigationFilter disturbed = begun(truth, p), undisturbed = begun(twin, p);
  for (int k = 0; k < 4000; ++k) {
    disturbed.add(truth.next());
    undisturbed.add(twin.next());
    if (is_fix_time(truth)) disturbed.add(truth.fix());
    if (is_fix_time(twin)) undisturbed.add(twin.fix());
    if (k % 20 != 19) continue;
    AirPressure sample = shown_at(truth, {});
    const bool slams = k > 2000 && k < 2400;
    if (!slams) undisturbed.add(sample);
    if (slams) sample.pressure_altitude_m -= 5.0;
    disturbed.add(sample);
  }
  std::size_t refused = 0;
  for (const UpdateResult& result : disturbed.take_results()) {
    const MeasurementResult* pressure = result.of("pressure_altitude");
    refused += pressure != nullptr && !pressure->accepted ? 1 : 0;
  }
  EXPECT_EQ(refused, 20U);
  EXPECT_LT(nav::ned_from(disturbed.filter()->state().position, undisturbed.filter()->state().position).norm(), 1e-6);
}

TEST(PressureAltitude, SamplesThatComeLateGiveTheSameBitsAsInTime) {
  const NavigationParameters p = told();
  Circling truth;
  NavigationFilter in_time = begun(truth, p), late = in_time;
  std::multimap<std::int64_t, AirPressure> on_their_way;
  std::int64_t count = 0;
  for (int k = 0; k < 2400; ++k) {
    const ImuSample sample = truth.next();
    in_time.add(sample);
    late.add(sample);
    if (is_fix_time(truth)) {
      in_time.add(truth.fix());
      late.add(truth.fix());
    }
    if (k % 20 == 7 && k < 2200) {
      AirPressure pressure = shown_at(truth, {});
      pressure.pressure_altitude_m += 0.2 * std::sin(k);
      in_time.add(pressure);
      on_their_way.emplace(truth.time_ns() + 110'000'000 + 150'000'000 * (3 * count++ % 5), pressure);
    }
    while (!on_their_way.empty() && on_their_way.begin()->first <= truth.time_ns()) {
      late.add(on_their_way.begin()->second);
      on_their_way.erase(on_their_way.begin());
    }
  }
  EXPECT_EQ(in_time.filter()->covariance().matrix(), late.filter()->covariance().matrix());
  EXPECT_EQ(in_time.filter()->state().position.height_m, late.filter()->state().position.height_m);
  EXPECT_EQ(in_time.filter()->estimates()[StateBlock::PressureBias],
            late.filter()->estimates()[StateBlock::PressureBias]);
  EXPECT_EQ(late.counts().fixes_too_old, 0U);
}

TEST(PressureAltitude, SaturatedSamplesAndThoseWithoutANumberAreNotUsed) {
  AirPressure sample;
  EXPECT_TRUE(PressureAltitude::usable(sample));
  sample.saturated = true;
  EXPECT_FALSE(PressureAltitude::usable(sample));
  sample.saturated = false;
  sample.pressure_altitude_m = air::pressure_altitude_m(0.0);
  EXPECT_FALSE(PressureAltitude::usable(sample));
}

// 0.0832 m/Pa: R T / (g p), 287.05287 288.15 / (9.80665 101325).
TEST(PressureAltitude, ItsParametersMatchAProfileAndChooseWhatThereIsToEstimate) {
  constexpr double kMetresPerPa = 0.083242139;
  BarometerErrorProfile errors;
  errors.white_sigma_pa = 1.2;
  errors.quantization_pa = std::sqrt(12.0) * 0.5;
  errors.time_constant_s = 0.05;
  InstallationProfile place, imu_place;
  place.lever_arm_v_m = Vector3(1.0, 0.0, 0.0);
  imu_place.lever_arm_v_m = Vector3(-1.0, 0.0, 0.0);
  imu_place.mounting_rpy_deg = Vector3(0.0, 0.0, 90.0);
  NavigationParameters p;
  match(errors, place, imu_place, p);
  EXPECT_NEAR(p.barometer.white_sigma_pa, 1.3, 1e-12);
  EXPECT_EQ(p.barometer.lag_s, 0.05);
  EXPECT_LT((p.barometer.lever_arm_b_m - Vector3(0.0, -2.0, 0.0)).norm(), 1e-12);
  EXPECT_FALSE(p.states.pressure_bias || p.states.pressure_slope);
  errors.geoid_height_m = 30.0;
  errors.sea_level_pressure_pa += 40.0 / kMetresPerPa;
  errors.sea_level_pressure_gm_sigma_pa = 40.0;
  errors.sea_level_pressure_gm_correlation_time_s = 7200.0;
  errors.sea_level_pressure_rate_pa_per_h = -180.0;
  errors.gm_sigma_pa = 3.0;
  errors.gm_correlation_time_s = 900.0;
  errors.temperature_deviation_deg_c = -0.03 * 288.15;
  errors.static_pressure_coefficient = -0.08;
  match(errors, place, imu_place, p);
  EXPECT_LT((p.barometer.bias_sigma_m - Vector3(50.0, 50.0 * kMetresPerPa, 3.0 * kMetresPerPa)).norm(), 1e-5);
  EXPECT_EQ(p.barometer.bias_correlation_time_s, Vector3(0.0, 7200.0, 900.0));
  EXPECT_NEAR(p.barometer.height_scale_sigma, 0.03, 1e-12);
  EXPECT_EQ(p.barometer.static_pressure_sigma, 0.08);
  EXPECT_TRUE(p.states.pressure_bias && p.states.pressure_slope);
}

/// A car on hills of 30 m that speeds up and slows down, so that every state is seen.
double nees_of_run(std::uint64_t seed) {
  NavigationParameters told_of = told();
  told_of.barometer.bias_correlation_time_s.setZero();
  DrawnRun run(told_of, seed, "pressure_altitude_test");
  const double bias_m = -run.of(StateBlock::PressureBias).sum();
  const Vector3 slope = -run.of(StateBlock::PressureSlope);
  for (int k = 0; k < 8000; ++k) {
    const double t_s = kDt_s * k;
    run.advance(Vector3(1.5 * std::cos(0.4 * t_s), 0.0, -0.6 * std::cos(0.2 * t_s)));
    if (k < 4000) run.fix_if_due();
    if (k % 20 != 19) continue;
    const nav::NavState now = run.truth().state();
    AirPressure sample;
    sample.header.sim_time_ns = run.truth().time_ns();
    sample.pressure_altitude_m = (1.0 + slope[0]) * air::geopotential_height_m(now.position.height_m) -
                                 slope[1] * now.v_n.squaredNorm() / (2.0 * air::kGMPerS2) + bias_m;
    const double metres_per_pa = 1.0 / (air::air_at(sample.pressure_altitude_m).density_kg_per_m3() * air::kGMPerS2);
    sample.pressure_altitude_m += metres_per_pa * told_of.barometer.white_sigma_pa * run.normal();
    run.filter().add(sample);
  }
  return run.nees();
}

// 40 s, of which the last 20 without fixes.
TEST(PressureAltitude, IsHonestWithItsBiasesOver100Runs) { expect_honest_over_100_runs(26, nees_of_run); }

}  // namespace pressure_altitude_test
}  // namespace inslab::navigation
