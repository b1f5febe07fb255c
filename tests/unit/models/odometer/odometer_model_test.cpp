#include "inslab/models/odometer/odometer_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::odometer {
namespace odometer_model_test {

constexpr std::int64_t kPeriodNs = 10000000;
constexpr double kDtS = 0.01;

OdometerModel::Setup setup(double rate_hz = 100.0) {
  OdometerModel::Setup s{42, 0, time::Rate(rate_hz), {}, {}};
  s.installation.target.kind = SensorKind::Odometer;
  return s;
}

/// A vehicle on the flat: how fast it drives, its acceleration forwards and its force to the right.
struct Drive {
  double speed_m_per_s = 10.0;
  double force_along_m_s2 = 0.0;
  double force_across_m_s2 = 0.0;
};

/// Drives north, whatever its force says: the model reads the way from places and velocities alone.
class Road {
 public:
  TruthState next(const Drive& drive = {}) {
    TruthState truth;
    truth.header.sim_time_ns = static_cast<std::int64_t>(k_++) * kPeriodNs;
    truth.interval_ns = truth.header.sim_time_ns > 0 ? kPeriodNs : 0;
    if (truth.interval_ns > 0) place_ = nav::displaced(place_, {drive.speed_m_per_s * kDtS, 0.0, 0.0});
    truth.latitude_rad = place_.latitude_rad;
    truth.longitude_rad = place_.longitude_rad;
    truth.height_m = place_.height_m;
    truth.v_n = {drive.speed_m_per_s, 0.0, 0.0};
    truth.omega_iv_v = nav::omega_ie_n(place_.latitude_rad);
    truth.dtheta_v = truth.omega_iv_v * kDtS;
    truth.dv_v = Vector3(drive.force_along_m_s2, drive.force_across_m_s2, -9.8) * kDtS;
    return truth;
  }

 private:
  std::uint64_t k_ = 0;
  nav::Geodetic place_{0.7, 0.3, 100.0};
};

double driven_m(OdometerModel& model, int samples, const Drive& drive) {
  Road road;
  model.measure(road.next(drive));
  double sum = 0.0;
  for (int k = 0; k < samples; ++k) {
    if (const auto sample = model.measure(road.next(drive))) sum += sample->distance_m;
  }
  return sum;
}

double first_m(const OdometerModel::Setup& s, const Drive& drive) {
  OdometerModel model(s);
  return driven_m(model, 1, drive);
}

FaultProfile fault(const std::function<void(FaultProfile&)>& change) {
  FaultProfile profile;
  profile.target.kind = SensorKind::Odometer;
  change(profile);
  return profile;
}

TEST(Odometer, APerfectOneShowsTheWayOfItsInterval) {
  Road road;
  OdometerModel model(setup(50.0));
  EXPECT_FALSE(model.measure(road.next()).has_value());
  EXPECT_FALSE(model.measure(road.next()).has_value());
  const auto sample = model.measure(road.next());
  EXPECT_EQ(sample->interval_ns, 2 * kPeriodNs);
  EXPECT_NEAR(sample->distance_m, 0.2, 1e-8);
  EXPECT_NEAR(sample->speed_m_per_s, 10.0, 1e-6);
  EXPECT_EQ(sample->header.sequence_number, 0U);
}

TEST(Odometer, AcceleratingTheWayIsTheIntegralOfTheSpeed) {
  // From 10 m/s with 3 m/s^2: 10 t + 1.5 t^2, in intervals of the truth as long as 0.1 s.
  TruthState start, end;
  start.latitude_rad = end.latitude_rad = 0.7;
  start.v_n = {10.0, 0.0, 0.0};
  end.v_n = {10.3, 0.0, 0.0};
  end.interval_ns = 100000000;
  const nav::Geodetic place = nav::displaced(geodetic_of(start), {1.015, 0.0, 0.0});
  end.latitude_rad = place.latitude_rad;
  end.height_m = place.height_m;
  WheelContact contact;
  contact.use(InstallationProfile{});
  EXPECT_NEAR(contact.over(start, end).along_m, 1.015, 1e-8);
}

TEST(Odometer, RollsAtItsContactAlongItsAxis) {
  // Turning right at 0.5 rad/s the wheel on the right, 0.8 m from the middle, is slower by 0.4 m/s.
  constexpr double kRate = 0.5, kSpeed = 10.0;
  const auto at = [&](double t_s) {
    TruthState truth;
    const double yaw = kRate * t_s, radius = kSpeed / kRate;
    const nav::Geodetic place =
        nav::displaced({0.7, 0.3, 100.0}, {radius * std::sin(yaw), radius * (1.0 - std::cos(yaw)), 0.0});
    truth.latitude_rad = place.latitude_rad;
    truth.longitude_rad = place.longitude_rad;
    truth.height_m = 100.0;
    truth.v_n = kSpeed * Vector3(std::cos(yaw), std::sin(yaw), 0.0);
    truth.q_nv = nav::quaternion_from_rpy({0.0, 0.0, yaw});
    truth.omega_iv_v = Vector3(0.0, 0.0, kRate) + truth.q_nv.conjugate() * nav::omega_ie_n(0.7);
    truth.dtheta_v = kDtS * truth.omega_iv_v;
    truth.interval_ns = kPeriodNs;
    return truth;
  };
  InstallationProfile right;
  right.target.kind = SensorKind::Odometer;
  right.lever_arm_v_m = {-1.2, 0.8, 0.4};
  right.mounting_rpy_deg = {0.0, 0.0, 2.0};
  WheelContact contact;
  contact.use(right);
  double way_m = 0.0;
  for (int k = 0; k < 100; ++k) way_m += contact.over(at(k * kDtS), at((k + 1) * kDtS)).along_m;
  // The toe of 2 deg to the right shows cos of the forward speed and sin of the rightward one, omega times -1.2 m.
  const double expected =
      (kSpeed - kRate * 0.8) * std::cos(2.0 * units::kDeg) - kRate * 1.2 * std::sin(2.0 * units::kDeg);
  EXPECT_NEAR(way_m, expected, 2e-6 * expected);  // places of the flat circle lie on the ellipsoid to d/R of its size
}

TEST(Odometer, ScaleAndWarmingActAsTheEquationSays) {
  OdometerModel::Setup s = setup(1.0);
  s.errors.scale_factor_ppm = 5000.0;
  s.errors.tyre_warming_ppm = -2000.0;
  s.errors.tyre_warming_time_s = 2.0;
  OdometerModel model(s);
  EXPECT_NEAR(driven_m(model, 100, {20.0}), 20.0 * (1.005 - 0.002 * (1.0 - std::exp(-0.5))), 1e-7);
}

TEST(Odometer, ScaleIsDrawnOnceAndDrifts) {
  // 200 sets: a variance has the relative standard error sqrt(2/200).
  double turn_on = 0.0, drift = 0.0;
  constexpr int kSets = 200;
  for (int i = 0; i < kSets; ++i) {
    OdometerModel::Setup s = setup();
    s.seed = 100 + static_cast<std::uint64_t>(i);
    s.errors.scale_factor_turn_on_sigma_ppm = 1000.0;
    turn_on += std::pow((first_m(s, {}) / 0.1 - 1.0) / 1e-3, 2) / kSets;
    s.errors.scale_factor_turn_on_sigma_ppm = 0.0;
    s.errors.scale_factor_gm_sigma_ppm = 1000.0;
    s.errors.scale_factor_gm_correlation_time_s = 100.0;
    drift += std::pow((first_m(s, {}) / 0.1 - 1.0) / 1e-3, 2) / kSets;
  }
  EXPECT_NEAR(turn_on, 1.0, 4.0 * std::sqrt(2.0 / kSets));
  EXPECT_NEAR(drift, 1.0, 4.0 * std::sqrt(2.0 / kSets));
}

TEST(Odometer, TheErrorOfTheRoadGrowsWithTheRootOfTheWay) {
  OdometerModel::Setup s = setup();
  s.errors.noise_m_per_sqrt_m = 0.01;
  OdometerModel model(s);
  Road road;
  model.measure(road.next());
  double variance = 0.0;
  constexpr int kSamples = 20000;
  for (int k = 0; k < kSamples; ++k) {
    variance += std::pow(model.measure(road.next())->distance_m - 0.1, 2) / kSamples;
  }
  EXPECT_NEAR(variance, 1e-4 * 0.1, 4.0 * 1e-5 * std::sqrt(2.0 / kSamples));
}

TEST(Odometer, SlipsBeyondItsThresholdsOnly) {
  OdometerModel::Setup s = setup();
  s.errors.longitudinal_slip_threshold_m_per_s2 = 2.0;
  s.errors.longitudinal_slip_s2_per_m = 0.05;
  s.errors.lateral_slip_threshold_m_per_s2 = 4.0;
  s.errors.lateral_slip_s2_per_m = 0.1;
  EXPECT_NEAR(first_m(s, {10.0, 1.9, -3.9}), 0.1, 1e-8);
  EXPECT_NEAR(first_m(s, {10.0, 3.0, 0.0}), 0.1 * 1.05, 1e-8);           // driven: it spins
  EXPECT_NEAR(first_m(s, {10.0, -3.0, 0.0}), 0.1 * 0.95, 1e-8);          // braked: it drags
  EXPECT_NEAR(first_m(s, {10.0, -3.0, 5.0}), 0.1 * (0.95 - 0.1), 1e-8);  // and sideways more so
  EXPECT_NEAR(first_m(s, {10.0, -40.0, 0.0}), 0.0, 1e-12);               // locked
  EXPECT_NEAR(first_m(s, {-10.0, -3.0, 0.0}), -0.1 * 1.05, 1e-8);        // driven backwards
}

TEST(Odometer, CountsKeepTheirRemainder) {
  OdometerModel::Setup s = setup();
  s.errors.counts_per_revolution = 96.0;
  s.errors.wheel_circumference_m = 1.92;  // 2 cm a count
  OdometerModel model(s);
  Road road;
  model.measure(road.next());
  std::int64_t counts = 0;
  for (int k = 1; k <= 5000; ++k) {
    const WheelTravel sample = *model.measure(road.next({0.333}));
    counts += sample.counts;
    EXPECT_NEAR(sample.distance_m, 0.02 * static_cast<double>(sample.counts), 1e-12);
    ASSERT_LT(std::abs(static_cast<double>(counts) - 0.00333 * k / 0.02), 1.0) << k;
  }
}

TEST(Odometer, BackwardsCountsDownWhereTheDirectionIsKnown) {
  OdometerModel::Setup s = setup();
  EXPECT_NEAR(first_m(s, {-5.0}), -0.05, 1e-8);
  s.errors.direction_known = false;
  EXPECT_NEAR(first_m(s, {-5.0}), 0.05, 1e-8);
}

TEST(Odometer, SlowerThanItHearsItShowsNothing) {
  OdometerModel::Setup s = setup();
  s.errors.dead_below_m_per_s = 0.5;
  EXPECT_EQ(first_m(s, {0.49}), 0.0);
  EXPECT_EQ(first_m(s, {-0.49}), 0.0);
  EXPECT_NEAR(first_m(s, {0.51}), 0.0051, 1e-8);
}

TEST(Odometer, AFaultActsWhileItIsOn) {
  Road road;
  OdometerModel model(setup());
  model.measure(road.next());
  model.measure(road.next());
  const auto distance_m = [&](const std::function<void(FaultProfile&)>& change, double speed_m_per_s = 10.0) {
    model.apply(fault(change));
    return model.measure(road.next({speed_m_per_s}))->distance_m;
  };
  EXPECT_NEAR(distance_m([](FaultProfile& f) { f.wheel_speed_jump_m_per_s = 2.0; }), 0.12, 1e-8);
  EXPECT_NEAR(distance_m([](FaultProfile& f) { f.odometer_fault = AxisFault::Stuck; }), 0.12, 1e-8);
  EXPECT_NEAR(distance_m([](FaultProfile& f) { f.odometer_fault = AxisFault::SignFlip; }), -0.1, 1e-8);
  EXPECT_EQ(distance_m([](FaultProfile& f) { f.wheel_locked = true; }), 0.0);
  EXPECT_TRUE(std::isnan(distance_m([](FaultProfile& f) { f.odometer_fault = AxisFault::Nan; })));
  model.apply(fault([](FaultProfile& f) { f.odometer_silent = true; }));
  EXPECT_FALSE(model.measure(road.next()).has_value());
  EXPECT_NEAR(distance_m([](FaultProfile&) {}), 0.1, 1e-8);  // the silent way is lost
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.gyro_silent = true; })), std::invalid_argument);
}

TEST(Odometer, RefusesATruthThatDoesNotContinue) {
  Road road;
  OdometerModel model(setup());
  model.measure(road.next());
  road.next();
  EXPECT_THROW(model.measure(road.next()), std::invalid_argument);
}

}  // namespace odometer_model_test
}  // namespace inslab::odometer
