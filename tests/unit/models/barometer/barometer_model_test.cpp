#include "inslab/models/barometer/barometer_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::barometer {
namespace barometer_model_test {

namespace atmosphere = nav::standard_atmosphere;

constexpr std::int64_t kPeriodNs = 20000000;

BarometerModel::Setup setup() {
  BarometerModel::Setup s{42, 0, time::Rate(50.0), {}, {}};
  s.installation.target.kind = SensorKind::Barometer;
  return s;
}

TruthState truth_at(std::uint64_t k, double height_m = 500.0) {
  TruthState truth;
  truth.header.sim_time_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  truth.interval_ns = kPeriodNs;
  truth.latitude_rad = 0.84;
  truth.longitude_rad = 0.2;
  truth.height_m = height_m;
  return truth;
}

double standard_pa(double height_m) {
  return atmosphere::air_at(atmosphere::geopotential_height_m(height_m)).pressure_pa;
}

FaultProfile fault(const std::function<void(FaultProfile&)>& change) {
  FaultProfile profile;
  profile.target.kind = SensorKind::Barometer;
  change(profile);
  return profile;
}

TEST(Barometer, APerfectOneShowsTheStandardAtmosphereOverTheGeoid) {
  BarometerModel::Setup s = setup();
  s.errors.geoid_height_m = 46.0;
  BarometerModel model(s);
  const AirPressure sample = *model.observe(truth_at(1, 1046.0));
  EXPECT_NEAR(sample.pressure_pa, standard_pa(1000.0), 1e-9);
  EXPECT_NEAR(sample.pressure_altitude_m, atmosphere::geopotential_height_m(1000.0), 1e-8);
  EXPECT_NEAR(sample.temperature_deg_c, 15.0 - 6.5e-3 * atmosphere::geopotential_height_m(1000.0), 1e-9);
}

TEST(Barometer, StandsWhereItsArmSays) {
  BarometerModel::Setup s = setup();
  s.installation.lever_arm_v_m = {0.0, 0.0, -30.0};
  BarometerModel model(s);
  EXPECT_NEAR(model.observe(truth_at(1))->pressure_pa, standard_pa(530.0), 1e-6);
}

TEST(Barometer, TheDaysAirIsThatOfTheProfile) {
  BarometerModel::Setup s = setup();
  s.errors.sea_level_pressure_pa = 99000.0;
  s.errors.sea_level_pressure_rate_pa_per_h = 360.0;
  s.errors.temperature_deviation_deg_c = 12.0;
  BarometerModel model(s);
  // 0.1 Pa a second.
  const double expected = atmosphere::air_at(atmosphere::geopotential_height_m(500.0), 99000.1, 12.0).pressure_pa;
  EXPECT_NEAR(model.observe(truth_at(50))->pressure_pa, expected, 1e-8);
}

TEST(Barometer, TheStaticErrorIsThatOfTheDynamicPressure) {
  BarometerModel::Setup s = setup();
  s.errors.static_pressure_coefficient = -0.1;
  BarometerModel model(s);
  TruthState truth = truth_at(1);
  truth.v_n = {30.0, 40.0, 0.0};
  const atmosphere::Air air = atmosphere::air_at(atmosphere::geopotential_height_m(500.0));
  const double q_pa = 0.5 * air.pressure_pa / (287.05287 * air.temperature_k) * 2500.0;
  EXPECT_NEAR(model.observe(truth)->pressure_pa, air.pressure_pa - 0.1 * q_pa, 1e-8);
}

TEST(Barometer, TheLagAnswersAsTheEquationSays) {
  // Up by one step, from which the error dies as e^(-t/T); the step itself is a ramp over one interval.
  BarometerModel::Setup s = setup();
  s.errors.time_constant_s = 0.5;
  BarometerModel model(s);
  model.observe(truth_at(1, 100.0));
  const double dt_s = 0.02, T = 0.5, step_pa = standard_pa(200.0) - standard_pa(100.0);
  const double left = step_pa / dt_s * T * (1.0 - std::exp(-dt_s / T));  // of the ramp, at its end
  for (std::uint64_t k = 2; k <= 100; ++k) {
    const double expected = standard_pa(200.0) - left * std::exp(-static_cast<double>(k - 2) * dt_s / T);
    EXPECT_NEAR(model.observe(truth_at(k, 200.0))->pressure_pa, expected, 1e-8) << k;
  }
}

TEST(Barometer, NoiseHasItsSigmaAndItsCorrelation) {
  // N samples: a variance has the relative standard error sqrt(2/N) for white noise, sqrt(2 (2T/dt)/N) for the
  // Gauss-Markov process, whose autocorrelation after its correlation time is 1/e.
  constexpr int kSamples = 40000;
  const auto errors = [](double white_pa, double gm_pa) {
    BarometerModel::Setup s = setup();
    s.errors.white_sigma_pa = white_pa;
    s.errors.gm_sigma_pa = gm_pa;
    s.errors.gm_correlation_time_s = 0.2;
    BarometerModel model(s);
    std::vector<double> out;
    for (std::uint64_t k = 1; k <= kSamples; ++k) {
      out.push_back(model.observe(truth_at(k))->pressure_pa - standard_pa(500.0));
    }
    return out;
  };
  const auto correlation = [](const std::vector<double>& x, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = lag; k < x.size(); ++k) sum += x[k] * x[k - lag] / kSamples;
    return sum;
  };
  EXPECT_NEAR(correlation(errors(3.0, 0.0), 0), 9.0, 4.0 * 9.0 * std::sqrt(2.0 / kSamples));
  const std::vector<double> gm = errors(0.0, 10.0);
  const double gm_error = 4.0 * 100.0 * std::sqrt(2.0 * 20.0 / kSamples);
  EXPECT_NEAR(correlation(gm, 0), 100.0, gm_error);
  EXPECT_NEAR(correlation(gm, 10), 100.0 / std::exp(1.0), gm_error);
}

TEST(Barometer, TwoInOneUnitAreInTheSameWeatherAndHaveNoiseOfTheirOwn) {
  BarometerModel::Setup s = setup();
  s.errors.sea_level_pressure_gm_sigma_pa = 300.0;
  s.errors.sea_level_pressure_gm_correlation_time_s = 3600.0;
  s.errors.temperature_deviation_gm_sigma_deg_c = 2.0;
  s.errors.temperature_deviation_gm_correlation_time_s = 3600.0;
  const auto shown_pa = [&s](std::uint32_t number, double white_pa) {
    s.sensor_number = number;
    s.errors.white_sigma_pa = white_pa;
    return BarometerModel(s).observe(truth_at(1))->pressure_pa;
  };
  EXPECT_EQ(shown_pa(0, 0.0), shown_pa(1, 0.0));
  EXPECT_GT(std::abs(shown_pa(0, 0.0) - standard_pa(500.0)), 1.0);
  EXPECT_NE(shown_pa(0, 5.0), shown_pa(1, 5.0));
}

TEST(Barometer, RangeAndCountsLimitWhatComesOut) {
  BarometerModel::Setup s = setup();
  s.errors.min_pressure_pa = 30000.0;
  s.errors.max_pressure_pa = 90000.0;
  s.errors.quantization_pa = 7.0;
  BarometerModel model(s);
  const AirPressure low = *model.observe(truth_at(1, 0.0));
  EXPECT_TRUE(low.saturated);
  EXPECT_NEAR(low.pressure_pa, 90000.0, 3.5);
  const AirPressure inside = *model.observe(truth_at(2, 3000.0));
  EXPECT_FALSE(inside.saturated);
  EXPECT_EQ(std::remainder(inside.pressure_pa, 7.0), 0.0);
  EXPECT_NEAR(inside.pressure_pa, standard_pa(3000.0), 3.5);
  EXPECT_TRUE(model.observe(truth_at(3, 12000.0))->saturated);
}

TEST(Barometer, AFaultActsWhileItIsOn) {
  BarometerModel model(setup());
  const AirPressure before = *model.observe(truth_at(1));
  model.apply(fault([](FaultProfile& f) { f.pressure_jump_pa = 120.0; }));
  EXPECT_NEAR(model.observe(truth_at(2))->pressure_pa, before.pressure_pa + 120.0, 1e-9);
  model.apply(fault([](FaultProfile& f) { f.barometer_fault = AxisFault::Stuck; }));
  EXPECT_NEAR(model.observe(truth_at(3, 900.0))->pressure_pa, before.pressure_pa + 120.0, 1e-9);
  model.apply(fault([](FaultProfile& f) { f.barometer_fault = AxisFault::Nan; }));
  EXPECT_TRUE(std::isnan(model.observe(truth_at(4))->pressure_altitude_m));
  model.apply(fault([](FaultProfile& f) { f.barometer_silent = true; }));
  EXPECT_FALSE(model.observe(truth_at(5)).has_value());
  model.apply(fault([](FaultProfile&) {}));
  const auto after = model.observe(truth_at(6));
  EXPECT_EQ(after->pressure_pa, before.pressure_pa);
  EXPECT_EQ(after->header.sequence_number, 4U);
}

TEST(Barometer, AnotherKindsFaultIsRefused) {
  BarometerModel model(setup());
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.outage = true; })), std::invalid_argument);
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.wheel_speed_jump_m_per_s = 1.0; })), std::invalid_argument);
}

TEST(Barometer, ASilentTimeChangesNoLaterDraw) {
  BarometerModel::Setup s = setup();
  s.errors.white_sigma_pa = 2.0;
  s.errors.gm_sigma_pa = 5.0;
  s.errors.gm_correlation_time_s = 10.0;
  BarometerModel heard(s), silent(s);
  silent.apply(fault([](FaultProfile& f) { f.barometer_silent = true; }));
  for (std::uint64_t k = 1; k <= 20; ++k) heard.observe(truth_at(k)), silent.observe(truth_at(k));
  silent.apply(fault([](FaultProfile&) {}));
  EXPECT_EQ(heard.observe(truth_at(21))->pressure_pa, silent.observe(truth_at(21))->pressure_pa);
}

TEST(Barometer, ASwappedProfileKeepsItsStatesInUnitsOfSigmaUnlessTold) {
  BarometerModel::Setup s = setup();
  s.errors.gm_sigma_pa = 10.0;
  s.errors.gm_correlation_time_s = 1e6;
  BarometerErrorProfile twice = s.errors;
  twice.gm_sigma_pa = 20.0;
  BarometerModel kept(s), reset(s);
  const double before = kept.observe(truth_at(1))->pressure_pa - standard_pa(500.0);
  reset.observe(truth_at(1));
  kept.apply(twice);
  EXPECT_NEAR(kept.observe(truth_at(2))->pressure_pa - standard_pa(500.0), 2.0 * before, 0.02);
  twice.request.continuity = Continuity::Reset;
  reset.apply(twice);
  EXPECT_NEAR(reset.observe(truth_at(2))->pressure_pa - standard_pa(500.0), 0.0, 0.02);
}

}  // namespace barometer_model_test
}  // namespace inslab::barometer
