#include <gtest/gtest.h>

#include "inslab/data/catalog/profile_rules.hpp"
#include "tests/unit/models/air_data/air_data_scene.hpp"

/// What blocked pitot tubes, drains and static ports, and frozen vanes, show.
namespace inslab::air_data {
namespace ice_test {

using scene::air_over;
using scene::fault;
using scene::Flight;
using scene::impact_pa;
using scene::setup;
using scene::truth_at;

Flight at_height(double height_m, double speed_m_per_s = 100.0) {
  return {{speed_m_per_s, 0.0, 0.0}, 0.0, 0.0, 0.0, height_m};
}

TEST(Ice, InTheMouthOfATubeWithAnOpenDrainTakesTheAirspeedToZero) {
  AirDataModel::Setup s = setup();
  s.errors.drain_time_constant_s = 0.4;
  AirDataModel model(s);
  model.observe(truth_at(1));
  model.apply(fault([](FaultProfile& f) { f.pitot_blocked = true; }));
  for (std::uint64_t k = 2; k <= 200; ++k) {
    const Airflow sample = model.observe(truth_at(k))->sample;
    const double left = std::exp(-static_cast<double>(k - 1) * scene::kPeriodS / 0.4);
    EXPECT_NEAR(sample.impact_pressure_pa, left * impact_pa(500.0, 100.0), 1e-8) << k;
  }
  EXPECT_LT(model.observe(truth_at(201, at_height(500.0, 150.0)))->sample.calibrated_airspeed_m_per_s, 1.0);
  model.apply(fault([](FaultProfile&) {}));
  EXPECT_NEAR(model.observe(truth_at(202))->sample.impact_pressure_pa, impact_pa(500.0, 100.0), 1e-8);
}

TEST(Ice, InMouthAndDrainMakesAnAltimeterOfTheAirspeed) {
  AirDataModel model(setup());
  model.observe(truth_at(1));
  model.apply(fault([](FaultProfile& f) { f.pitot_blocked = f.pitot_drain_blocked = true; }));
  const double kept_pa = air_over(500.0).pressure_pa + impact_pa(500.0, 100.0);
  // Slower or faster it shows the same, higher more, lower less, and below some height nothing.
  EXPECT_NEAR(model.observe(truth_at(2, at_height(500.0, 60.0)))->sample.impact_pressure_pa, impact_pa(500.0, 100.0),
              1e-8);
  const Airflow high = model.observe(truth_at(3, at_height(1500.0)))->sample;
  EXPECT_NEAR(high.impact_pressure_pa, kept_pa - air_over(1500.0).pressure_pa, 1e-8);
  EXPECT_GT(high.calibrated_airspeed_m_per_s, 150.0);
  const Airflow low = model.observe(truth_at(4, at_height(-200.0)))->sample;
  EXPECT_NEAR(low.impact_pressure_pa, kept_pa - air_over(-200.0).pressure_pa, 1e-8);
  EXPECT_EQ(low.calibrated_airspeed_m_per_s, 0.0);
}

TEST(Ice, InTheDrainAloneIsNotSeen) {
  AirDataModel::Setup s = setup();
  s.errors.pitot_time_constant_s = 0.2;
  AirDataModel iced(s), clear(s);
  iced.apply(fault([](FaultProfile& f) { f.pitot_drain_blocked = true; }));
  for (std::uint64_t k = 1; k <= 20; ++k) {
    const Flight flight = at_height(500.0, 100.0 + static_cast<double>(k));
    EXPECT_EQ(iced.observe(truth_at(k, flight))->sample.impact_pressure_pa,
              clear.observe(truth_at(k, flight))->sample.impact_pressure_pa);
  }
}

TEST(Ice, InTheStaticPortStopsTheAltimeterAndSlowsTheAirspeedInAClimb) {
  AirDataModel model(setup());
  model.observe(truth_at(1));
  model.apply(fault([](FaultProfile& f) { f.static_port_blocked = true; }));
  const Airflow sample = model.observe(truth_at(2, at_height(800.0)))->sample;
  const double kept_pa = air_over(500.0).pressure_pa;
  EXPECT_NEAR(sample.static_pressure_pa, kept_pa, 1e-9);
  EXPECT_NEAR(sample.pressure_altitude_m, nav::standard_atmosphere::geopotential_height_m(500.0), 1e-7);
  EXPECT_NEAR(sample.impact_pressure_pa, air_over(800.0).pressure_pa + impact_pa(800.0, 100.0) - kept_pa, 1e-8);
  EXPECT_LT(sample.calibrated_airspeed_m_per_s, 75.0);
}

TEST(Ice, ThatIsThereFromTheBeginningKeepsThePressureOfTheBeginning) {
  AirDataModel model(setup());
  model.apply(fault([](FaultProfile& f) { f.static_port_blocked = true; }));
  model.observe(truth_at(1));
  EXPECT_NEAR(model.observe(truth_at(2, at_height(900.0)))->sample.static_pressure_pa, air_over(500.0).pressure_pa,
              1e-9);
}

TEST(Ice, OnTheVanesKeepsTheirAngles) {
  AirDataModel::Setup s = setup();
  s.errors.angle_of_attack.bias_deg = 0.5;
  AirDataModel model(s);
  model.observe(truth_at(1, {{100.0, 0.0, 0.0}, 0.0, 4.0}));
  model.apply(fault([](FaultProfile& f) { f.vanes_frozen = true; }));
  const auto output = *model.observe(truth_at(2, {{100.0, 0.0, 0.0}, 0.0, 9.0, 5.0}));
  EXPECT_NEAR(output.sample.angle_of_attack_rad, 4.5 * units::kDeg, 1e-12);
  EXPECT_NEAR(output.sample.angle_of_sideslip_rad, 0.0, 1e-12);
  EXPECT_GT(std::abs(output.truth.angle_of_sideslip_rad), 4.0 * units::kDeg);
}

TEST(Ice, IsNoFaultOfAnotherSensorNorAnotherSensorsOfThis) {
  AirDataModel model(setup());
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.barometer_silent = true; })), std::invalid_argument);
  FaultProfile of_barometer = fault([](FaultProfile& f) { f.pitot_blocked = true; });
  of_barometer.target.kind = SensorKind::Barometer;
  EXPECT_TRUE(catalog::violation(of_barometer));
}

TEST(Lines, LagByTheirTimeConstants) {
  // A step of the speed comes as a ramp over one sample; its rest dies as e^(-t/T).
  AirDataModel::Setup s = setup();
  s.errors.pitot_time_constant_s = 0.25;
  AirDataModel model(s);
  model.observe(truth_at(1, at_height(500.0, 80.0)));
  const double step_pa = impact_pa(500.0, 100.0) - impact_pa(500.0, 80.0);
  const double left_pa = step_pa * 0.25 / scene::kPeriodS * (1.0 - std::exp(-scene::kPeriodS / 0.25));
  for (std::uint64_t k = 2; k <= 60; ++k) {
    const double rest_pa = left_pa * std::exp(-static_cast<double>(k - 2) * scene::kPeriodS / 0.25);
    EXPECT_NEAR(model.observe(truth_at(k))->sample.impact_pressure_pa, impact_pa(500.0, 100.0) - rest_pa, 1e-8) << k;
  }
}

}  // namespace ice_test
}  // namespace inslab::air_data
