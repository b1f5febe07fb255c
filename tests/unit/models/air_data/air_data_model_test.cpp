#include "inslab/models/air_data/air_data_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/models/air_data/air_data_scene.hpp"

namespace inslab::air_data {
namespace air_data_model_test {

using scene::Flight;
using scene::impact_pa;
using scene::setup;
using scene::truth_at;

Airflow shown(const AirDataModel::Setup& s, const Flight& flight = {}) {
  return AirDataModel(s).observe(truth_at(1, flight))->sample;
}

AirDataModel::Setup in_wind(const Vector3& wind_ned_m_per_s) {
  AirDataModel::Setup s = setup();
  s.errors.wind.levels = {{10.0, wind_ned_m_per_s}};
  return s;
}

TEST(AirData, APerfectProbeInStillAirShowsTheSpeedOverGround) {
  const Airflow sample = shown(setup());
  const auto air = scene::air_over(500.0);
  EXPECT_NEAR(sample.impact_pressure_pa, impact_pa(500.0, 100.0), 1e-8);
  EXPECT_NEAR(sample.static_pressure_pa, air.pressure_pa, 1e-9);
  EXPECT_NEAR(sample.true_airspeed_m_per_s, 100.0, 1e-9);
  EXPECT_NEAR(sample.mach, 100.0 / std::sqrt(1.4 * 287.05287 * air.temperature_k), 1e-12);
  EXPECT_NEAR(sample.pressure_altitude_m, nav::standard_atmosphere::geopotential_height_m(500.0), 1e-7);
  EXPECT_NEAR(sample.angle_of_attack_rad, 0.0, 1e-12);
  EXPECT_NEAR(sample.angle_of_sideslip_rad, 0.0, 1e-12);
  EXPECT_FALSE(sample.saturated);
}

TEST(AirData, CalibratedAirspeedIsThatOfTheSamePressureAtSeaLevel) {
  const Airflow sample = shown(setup(), {{150.0, 0.0, 0.0}, 0.0, 0.0, 0.0, 9000.0});
  const double of_definition_pa =
      101325.0 * (std::pow(1.0 + 0.2 * std::pow(sample.calibrated_airspeed_m_per_s / 340.294, 2.0), 3.5) - 1.0);
  EXPECT_NEAR(of_definition_pa, impact_pa(9000.0, 150.0), 1e-5 * of_definition_pa);
  EXPECT_LT(sample.calibrated_airspeed_m_per_s, 100.0);
}

TEST(AirData, BehindAShockTheComputerFindsTheSpeedAgain) {
  const Airflow sample = shown(setup(), {{700.0, 0.0, 0.0}, 0.0, 0.0, 0.0, 15000.0});
  EXPECT_NEAR(sample.mach, 700.0 / 295.069, 5e-5);
  EXPECT_NEAR(sample.true_airspeed_m_per_s, 700.0, 1e-8);
}

TEST(AirData, HeadWindAddsAndTailWindTakesAway) {
  EXPECT_NEAR(shown(in_wind({-20.0, 0.0, 0.0})).true_airspeed_m_per_s, 120.0, 1e-9);
  EXPECT_NEAR(shown(in_wind({20.0, 0.0, 0.0})).true_airspeed_m_per_s, 80.0, 1e-9);
}

TEST(AirData, ANoseAboveThePathOrAirThatRisesIsAngleOfAttack) {
  const Airflow pitched = shown(setup(), {{100.0, 0.0, 0.0}, 0.0, 5.0});
  EXPECT_NEAR(pitched.angle_of_attack_rad, 5.0 * units::kDeg, 1e-12);
  EXPECT_NEAR(pitched.angle_of_sideslip_rad, 0.0, 1e-12);
  EXPECT_NEAR(shown(in_wind({0.0, 0.0, -10.0})).angle_of_attack_rad, std::atan(0.1), 1e-12);
}

TEST(AirData, FlowFromTheRightIsSideslip) {
  const Airflow sample = shown(in_wind({0.0, -20.0, 0.0}));
  EXPECT_NEAR(sample.angle_of_sideslip_rad, std::asin(20.0 / std::hypot(100.0, 20.0)), 1e-12);
  EXPECT_NEAR(sample.angle_of_attack_rad, 0.0, 1e-12);
  EXPECT_NEAR(sample.true_airspeed_m_per_s, std::hypot(100.0, 20.0), 1e-9);
  // Banked by 90 deg to the right the same wind comes from above.
  const Airflow banked = shown(in_wind({0.0, -20.0, 0.0}), {{100.0, 0.0, 0.0}, 90.0});
  EXPECT_NEAR(banked.angle_of_sideslip_rad, 0.0, 1e-12);
  EXPECT_NEAR(banked.angle_of_attack_rad, -std::atan(0.2), 1e-12);
}

TEST(AirData, OfPureCrosswindTheTubeFeelsNothing) {
  AirDataModel model(in_wind({0.0, -20.0, 0.0}));
  const auto output = *model.observe(truth_at(1, {Vector3::Zero()}));
  EXPECT_NEAR(output.truth.true_airspeed_m_per_s, 20.0, 1e-12);
  EXPECT_NEAR(output.truth.angle_of_sideslip_rad, 90.0 * units::kDeg, 1e-7);
  EXPECT_NEAR(output.sample.impact_pressure_pa, 0.0, 1e-10);
  EXPECT_NEAR(output.truth.impact_pressure_error.probe, -impact_pa(500.0, 20.0), 1e-9);
}

TEST(AirData, BeyondItsAngleATubeFeelsEverLess) {
  const double acceptance_rad = 20.0 * units::kDeg;
  const auto felt = [acceptance_rad](double angle_deg) {
    const double angle_rad = angle_deg * units::kDeg;
    return part_felt({50.0 * std::cos(angle_rad), 30.0 * std::sin(angle_rad), 40.0 * std::sin(angle_rad)},
                     acceptance_rad);
  };
  EXPECT_EQ(felt(0.0), 1.0);
  EXPECT_EQ(felt(19.9), 1.0);
  EXPECT_NEAR(felt(55.0), 0.5, 1e-12);  // half the way to abeam
  EXPECT_NEAR(felt(20.001), 1.0, 1e-8);
  EXPECT_EQ(felt(91.0), 0.0);
  EXPECT_EQ(felt(180.0), 0.0);
}

TEST(AirData, ABoomMovesByTheTurnOfTheVehicle) {
  AirDataModel::Setup s = setup();
  s.installation.lever_arm_v_m = {5.0, 0.0, 0.0};
  Flight flight{{50.0, 0.0, 0.0}};
  flight.omega_nv_v_rad_per_s = {0.0, 0.0, 0.4};
  // omega x l = (0, 2, 0) m/s: to the right, so the flow comes from there.
  const Airflow yawing = shown(s, flight);
  EXPECT_NEAR(yawing.angle_of_sideslip_rad, std::asin(2.0 / std::hypot(50.0, 2.0)), 1e-7);
  EXPECT_NEAR(yawing.true_airspeed_m_per_s, std::hypot(50.0, 2.0), 1e-6);
  flight.omega_nv_v_rad_per_s = {0.0, 0.4, 0.0};
  // The nose goes up, and the boom with it: (0, 0, -2) m/s, flow from above.
  EXPECT_NEAR(shown(s, flight).angle_of_attack_rad, -std::atan(2.0 / 50.0), 1e-7);
}

TEST(AirData, AnglesAreAgainstTheAxesOfTheBoom) {
  AirDataModel::Setup s = setup();
  s.installation.mounting_rpy_deg = {0.0, -3.0, 2.0};
  const Airflow sample = shown(s);
  // The boom looks 3 deg down and 2 deg to the right: the flow comes from above and from its left.
  const double p = 3.0 * units::kDeg, y = 2.0 * units::kDeg;
  EXPECT_NEAR(sample.angle_of_attack_rad, -std::atan2(std::sin(p) * std::cos(y), std::cos(p) * std::cos(y)), 1e-12);
  EXPECT_NEAR(sample.angle_of_sideslip_rad, -y, 1e-12);
}

TEST(AirData, TheWindIsThatOfTheProbesHeightAboveTheGround) {
  AirDataModel::Setup s = setup();
  s.errors.wind.ground_height_m = 400.0;
  s.errors.wind.levels = {{50.0, {0.0, 0.0, 0.0}}, {150.0, {-10.0, 0.0, 0.0}}};
  s.installation.lever_arm_v_m = {0.0, 0.0, -20.0};
  AirDataModel model(s);
  const auto output = *model.observe(truth_at(1));
  EXPECT_NEAR((output.truth.wind_ned_m_per_s - Vector3(-7.0, 0.0, 0.0)).norm(), 0.0, 1e-5);
  EXPECT_TRUE(output.truth.gust_ned_m_per_s.isZero(0.0));
}

TEST(AirData, TheStaticPortsPlaceErrsWithTheDynamicPressure) {
  AirDataModel::Setup s = setup();
  s.errors.static_pressure_coefficient = 0.06;
  AirDataModel model(s);
  const auto output = *model.observe(truth_at(1));
  const auto air = scene::air_over(500.0);
  const double error_pa = 0.06 * 0.5 * air.pressure_pa / (287.05287 * air.temperature_k) * 1e4;
  EXPECT_NEAR(output.sample.static_pressure_pa, air.pressure_pa + error_pa, 1e-8);
  EXPECT_NEAR(output.sample.impact_pressure_pa, impact_pa(500.0, 100.0) - error_pa, 1e-8);
  EXPECT_NEAR(output.truth.static_pressure_error.position, error_pa, 1e-9);
}

TEST(AirData, TheDaysAirIsThatOfTheProfile) {
  AirDataModel::Setup s = setup();
  s.errors.air = {46.0, 99000.0, 360.0, 0.0, 0.0, 12.0, 0.0, 0.0};
  AirDataModel model(s);
  const auto output = *model.observe(truth_at(50, {{100.0, 0.0, 0.0}, 0.0, 0.0, 0.0, 1046.0}));
  // 0.1 Pa a second.
  const auto expected =
      nav::standard_atmosphere::air_at(nav::standard_atmosphere::geopotential_height_m(1000.0), 99000.1, 12.0);
  EXPECT_NEAR(output.truth.static_pressure_pa, expected.pressure_pa, 1e-8);
  EXPECT_NEAR(output.truth.static_temperature_deg_c, expected.temperature_k - 273.15, 1e-9);
  EXPECT_NEAR(output.sample.true_airspeed_m_per_s, 100.0, 1e-9) << "the probe's temperature tells the day's";
}

TEST(AirData, TheTemperatureProbeFeelsTheFlow) {
  AirDataModel::Setup s = setup();
  const double static_k = scene::air_over(500.0).temperature_k;
  const double m2 = 1e4 / (1.4 * 287.05287 * static_k);
  EXPECT_NEAR(shown(s).total_temperature_deg_c, static_k * (1.0 + 0.2 * m2) - 273.15, 1e-9);
  s.errors.recovery_factor = 0.9;
  s.errors.temperature_offset_deg_c = -1.5;
  EXPECT_NEAR(shown(s).total_temperature_deg_c, static_k * (1.0 + 0.18 * m2) - 274.65, 1e-9);
}

TEST(AirData, SensorsErrByScaleOffsetRangeAndCounts) {
  AirDataModel::Setup s = setup();
  s.errors.impact_pressure = {10000.0, 12.0, 0.0, 0.0, 0.0, -500.0, 7000.0, 4.0};
  s.errors.static_pressure.offset_pa = -80.0;
  const Airflow sample = shown(s);
  EXPECT_NEAR(sample.impact_pressure_pa, 1.01 * impact_pa(500.0, 100.0) + 12.0, 2.0);
  EXPECT_EQ(std::remainder(sample.impact_pressure_pa, 4.0), 0.0);
  EXPECT_NEAR(sample.static_pressure_pa, scene::air_over(500.0).pressure_pa - 80.0, 1e-9);
  EXPECT_FALSE(sample.saturated);
  const Airflow fast = shown(s, {{130.0, 0.0, 0.0}});
  EXPECT_TRUE(fast.saturated);
  EXPECT_EQ(fast.impact_pressure_pa, 7000.0);
}

TEST(AirData, VanesErrByUpwashScaleBiasRangeAndCounts) {
  AirDataModel::Setup s = setup();
  s.errors.angle_of_attack.upwash = 0.2;
  s.errors.angle_of_attack.scale_factor_ppm = -50000.0;
  s.errors.angle_of_attack.bias_deg = 0.7;
  const Flight pitched{{100.0, 0.0, 0.0}, 0.0, 5.0};
  EXPECT_NEAR(shown(s, pitched).angle_of_attack_rad, (0.95 * 1.2 * 5.0 + 0.7) * units::kDeg, 1e-12);
  s.errors.angle_of_attack.quantization_deg = 0.25;
  EXPECT_NEAR(shown(s, pitched).angle_of_attack_rad, 6.5 * units::kDeg, 1e-12);  // 6.4
  s.errors.angle_of_attack.full_scale_deg = 6.0;
  EXPECT_NEAR(shown(s, pitched).angle_of_attack_rad, 6.0 * units::kDeg, 1e-12);
  EXPECT_TRUE(shown(s, pitched).saturated);
}

TEST(AirData, NoiseHasItsSigma) {
  // A standard deviation of N samples is within 4/sqrt(2N) of its own.
  constexpr int kSamples = 20000;
  AirDataModel::Setup s = setup();
  s.errors.impact_pressure.white_sigma_pa = 3.0;
  s.errors.static_pressure.white_sigma_pa = 5.0;
  s.errors.angle_of_sideslip.white_sigma_deg = 0.2;
  s.errors.temperature_white_sigma_deg_c = 0.5;
  AirDataModel model(s);
  const auto air = scene::air_over(500.0);
  const double warm_deg_c = shown(setup()).total_temperature_deg_c;
  double impact = 0.0, of_static = 0.0, sideslip = 0.0, temperature = 0.0;
  for (std::uint64_t k = 1; k <= kSamples; ++k) {
    const Airflow sample = model.observe(truth_at(k))->sample;
    impact += std::pow(sample.impact_pressure_pa - impact_pa(500.0, 100.0), 2.0) / kSamples;
    of_static += std::pow(sample.static_pressure_pa - air.pressure_pa, 2.0) / kSamples;
    sideslip += std::pow(sample.angle_of_sideslip_rad / units::kDeg, 2.0) / kSamples;
    temperature += std::pow(sample.total_temperature_deg_c - warm_deg_c, 2.0) / kSamples;
  }
  const double relative = 4.0 / std::sqrt(2.0 * kSamples);
  EXPECT_NEAR(std::sqrt(impact), 3.0, 3.0 * relative);
  EXPECT_NEAR(std::sqrt(of_static), 5.0, 5.0 * relative);
  EXPECT_NEAR(std::sqrt(sideslip), 0.2, 0.2 * relative);
  EXPECT_NEAR(std::sqrt(temperature), 0.5, 0.5 * relative);
}

TEST(AirData, BudgetsSumToWhatIsShownLessTheTruth) {
  AirDataModel::Setup s = in_wind({-8.0, 6.0, 1.0});
  s.errors.wind.turbulence = Turbulence::Severe;
  s.errors.acceptance_angle_deg = 1.0;
  s.errors.static_pressure_coefficient = 0.05;
  s.errors.pitot_time_constant_s = 0.1;
  s.errors.static_time_constant_s = 0.3;
  s.errors.impact_pressure = {5000.0, 20.0, 2.0, 3.0, 10.0, -100.0, 5000.0, 1.5};
  s.errors.static_pressure = {-300.0, -50.0, 4.0, 6.0, 10.0, 0.0, 0.0, 7.0};
  s.errors.angle_of_attack = {0.1, 2000.0, 0.4, 0.1, 0.2, 5.0, 4.0, 0.1};
  s.errors.angle_of_sideslip = {0.05, 0.0, -0.3, 0.1, 0.1, 5.0, 0.0, 0.0};
  AirDataModel model(s);
  bool was_saturated = false;
  for (std::uint64_t k = 1; k <= 500; ++k) {
    const double climb_m = 0.3 * static_cast<double>(k);
    if (k == 400) model.apply(scene::fault([](FaultProfile& f) { f.pitot_blocked = f.vanes_frozen = true; }));
    const auto [sample, truth] = *model.observe(truth_at(k, {{90.0, 5.0, -15.0}, 4.0, 9.0, 3.0, 300.0 + climb_m}));
    EXPECT_NEAR(truth.impact_pressure_pa + truth.impact_pressure_error.sum(), sample.impact_pressure_pa, 1e-8);
    EXPECT_NEAR(truth.static_pressure_pa + truth.static_pressure_error.sum(), sample.static_pressure_pa, 1e-8);
    EXPECT_NEAR(truth.angle_of_attack_rad + truth.angle_of_attack_error.sum(), sample.angle_of_attack_rad, 1e-13);
    EXPECT_NEAR(truth.angle_of_sideslip_rad + truth.angle_of_sideslip_error.sum(), sample.angle_of_sideslip_rad, 1e-13);
    was_saturated = was_saturated || sample.saturated;
  }
  EXPECT_TRUE(was_saturated);
}

TEST(AirData, ProbesOfOneUnitAreInTheSameGustsAndHaveNoiseOfTheirOwn) {
  AirDataModel::Setup s = setup();
  s.errors.wind.turbulence = Turbulence::Moderate;
  s.errors.impact_pressure.white_sigma_pa = 1.0;
  AirDataModel first(s);
  s.sensor_number = 1;
  s.installation.lever_arm_v_m = {3.0, -4.0, 0.0};
  AirDataModel second(s);
  for (std::uint64_t k = 1; k <= 30; ++k) {
    const auto a = *first.observe(truth_at(k)), b = *second.observe(truth_at(k));
    EXPECT_EQ(a.truth.gust_ned_m_per_s, b.truth.gust_ned_m_per_s);
    EXPECT_GT(a.truth.gust_ned_m_per_s.norm(), 0.0);
    EXPECT_NE(a.truth.impact_pressure_error.noise, b.truth.impact_pressure_error.noise);
  }
}

TEST(AirData, GustsComeWithTheWayThroughTheAirAndAlongTheWind) {
  // 3750 ft up moderate turbulence has 3.231 m/s and 533.4 m. At 106.68 m/s through the air the way of a second is a
  // fifth of that: over it the gust along the wind, which blows to the east, correlates by e^-0.2, that across it by
  // e^-0.2 0.9.
  constexpr int kSeeds = 4000;
  AirDataModel::Setup s = in_wind({0.0, 10.0, 0.0});
  s.errors.wind.turbulence = Turbulence::Moderate;
  const Flight flight{{0.0, 116.68, 0.0}, 0.0, 0.0, 90.0, 3750.0 * 0.3048};
  Vector3 variance = Vector3::Zero(), product = Vector3::Zero();
  for (int seed = 0; seed < kSeeds; ++seed) {
    s.seed = static_cast<std::uint64_t>(seed);
    AirDataModel model(s);
    const Vector3 first = model.observe(truth_at(1, flight))->truth.gust_ned_m_per_s;
    Vector3 last = first;
    for (std::uint64_t k = 2; k <= 51; ++k) last = model.observe(truth_at(k, flight))->truth.gust_ned_m_per_s;
    variance += last.cwiseAbs2() / kSeeds;
    product += first.cwiseProduct(last) / kSeeds;
  }
  const double power = std::pow(10.6 * 0.3048, 2.0);
  const Vector3 expected = std::exp(-0.2) * Vector3(0.9, 1.0, 0.9);
  for (int axis = 0; axis < 3; ++axis) {
    const double rho = expected[axis];
    EXPECT_NEAR(variance[axis], power, power * 4.0 * std::sqrt(2.0 / kSeeds)) << axis;
    EXPECT_NEAR(product[axis], power * rho, power * 4.0 * std::sqrt((1.0 + rho * rho) / kSeeds)) << axis;
  }
}

TEST(AirData, ASwapKeepsResetsOrRedrawsTheSensorsDriftAndNeverTheAir) {
  AirDataModel::Setup s = setup();
  s.errors.impact_pressure.gm_sigma_pa = 10.0;
  s.errors.impact_pressure.gm_correlation_time_s = 1e6;
  s.errors.wind.turbulence = Turbulence::Light;
  AirDataErrorProfile twice = s.errors;
  twice.impact_pressure.gm_sigma_pa = 20.0;
  AirDataModel kept(s), reset(s);
  const double before_pa = kept.observe(truth_at(1))->truth.impact_pressure_error.noise;
  reset.observe(truth_at(1));
  kept.apply(twice);
  twice.request.continuity = Continuity::Reset;
  reset.apply(twice);
  const auto a = *kept.observe(truth_at(2)), b = *reset.observe(truth_at(2));
  EXPECT_NEAR(a.truth.impact_pressure_error.noise, 2.0 * before_pa, 0.02);
  EXPECT_NEAR(b.truth.impact_pressure_error.noise, 0.0, 0.02);
  EXPECT_EQ(a.truth.gust_ned_m_per_s, b.truth.gust_ned_m_per_s);
}

}  // namespace air_data_model_test
}  // namespace inslab::air_data
