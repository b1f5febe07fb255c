#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/magnetometer/magnetometer_model.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::magnetometer {
namespace model_test {

constexpr std::int64_t kPeriodNs = 10000000;

MagnetometerModel::Setup setup(double rate_hz = 100.0) {
  MagnetometerModel::Setup s{42, 0, time::Rate(rate_hz), {}, {}};
  s.installation.target.kind = SensorKind::Magnetometer;
  return s;
}

TruthState truth_at(std::uint64_t k, const nav::RollPitchYaw& rpy = {0.0, 0.0, 0.0}) {
  TruthState truth;
  truth.header.gps_week = 2446;  // 2026-11-22
  truth.header.gps_time_of_week_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  truth.header.sim_time_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  truth.interval_ns = kPeriodNs;
  truth.latitude_rad = 0.53;
  truth.longitude_rad = 1.996;
  truth.height_m = 20.0;
  truth.q_nv = nav::quaternion_from_rpy(rpy);
  return truth;
}

Vector3 earth_n_nt() {
  const TruthState truth = truth_at(1);
  return EarthField(time::decimal_year({2446, 0})).B_n_nt(geodetic_of(truth));
}

FaultProfile fault(const std::function<void(FaultProfile&)>& change) {
  FaultProfile profile;
  profile.target.kind = SensorKind::Magnetometer;
  change(profile);
  return profile;
}

TEST(Magnetometer, APerfectOneShowsTheEarthAlongItsAxes) {
  MagnetometerModel::Setup s = setup();
  s.installation.mounting_rpy_deg = {10.0, -20.0, 30.0};
  MagnetometerModel model(s);
  const nav::RollPitchYaw rpy{0.4, -0.2, 2.0};
  const Matrix3 C_vb = nav::matrix_from_rpy({10.0 * units::kDeg, -20.0 * units::kDeg, 30.0 * units::kDeg});
  const Vector3 expected = C_vb.transpose() * (nav::matrix_from_rpy(rpy).transpose() * earth_n_nt());
  EXPECT_LT((model.observe(truth_at(1, rpy))->B_b_nt - expected).norm(), 1e-9 * expected.norm());
}

TEST(Magnetometer, SamplesComeAtItsInstantsFromTheFirstPeriodOn) {
  MagnetometerModel model(setup(50.0));
  std::vector<std::int64_t> times;
  for (std::uint64_t k = 0; k <= 10; ++k) {
    if (const auto sample = model.observe(truth_at(k))) {
      EXPECT_EQ(sample->header.sequence_number, times.size());
      times.push_back(sample->header.sim_time_ns);
    }
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{20000000, 40000000, 60000000, 80000000, 100000000}));
}

TEST(Magnetometer, IronAndCurrentsActAsTheEquationSays) {
  MagnetometerModel::Setup s = setup();
  s.errors.hard_iron_nt = {100.0, -200.0, 300.0};
  s.errors.soft_iron << 0.01, 0.02, 0.0, -0.02, 0.0, 0.03, 0.0, 0.0, -0.01;
  s.errors.currents = {{0.0, Vector3::Zero()}, {2.0, Vector3(400.0, 0.0, 0.0)}};
  MagnetometerModel model(s);
  Matrix3 S;
  S << 0.01, 0.02, 0.0, -0.02, 0.0, 0.03, 0.0, 0.0, -0.01;
  const Vector3 expected =
      (Matrix3::Identity() + S) * earth_n_nt() + Vector3(100.0, -200.0, 300.0) + Vector3(200.0, 0.0, 0.0);
  EXPECT_LT((model.observe(truth_at(100))->B_b_nt - expected).norm(), 1e-8);
}

TEST(Magnetometer, NoiseHasItsSigmaAndItsCorrelation) {
  // N samples: a variance has the relative standard error sqrt(2/N) for white noise, sqrt(2 (2T/dt)/N) for the
  // Gauss-Markov process, whose autocorrelation after its correlation time is 1/e.
  MagnetometerModel::Setup s = setup();
  s.errors.white_sigma_nt = {15.0, 0.0, 0.0};
  s.errors.gm_sigma_nt = {0.0, 50.0, 0.0};
  s.errors.gm_correlation_time_s = {0.0, 0.1, 0.0};
  MagnetometerModel model(s);
  const Vector3 truth = earth_n_nt();
  constexpr int kSamples = 40000;
  std::vector<Vector3> errors;
  for (std::uint64_t k = 1; k <= kSamples; ++k) errors.emplace_back(model.observe(truth_at(k))->B_b_nt - truth);
  double white = 0.0, gm = 0.0, lagged = 0.0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    white += errors[k].x() * errors[k].x() / kSamples;
    gm += errors[k].y() * errors[k].y() / kSamples;
    if (k >= 10) lagged += errors[k].y() * errors[k - 10].y() / kSamples;
  }
  EXPECT_NEAR(white, 225.0, 4.0 * 225.0 * std::sqrt(2.0 / kSamples));
  const double gm_error = 4.0 * 2500.0 * std::sqrt(2.0 * 20.0 / kSamples);
  EXPECT_NEAR(gm, 2500.0, gm_error);
  EXPECT_NEAR(lagged, 2500.0 / std::exp(1.0), gm_error);
}

TEST(Magnetometer, FullScaleAndCountsLimitWhatComesOut) {
  MagnetometerModel::Setup s = setup();
  s.errors.full_scale_nt = {1000.0, 0.0, 0.0};
  s.errors.quantization_nt = {0.0, 150.0, 0.0};
  MagnetometerModel model(s);
  const MagneticField sample = *model.observe(truth_at(1));
  EXPECT_TRUE(sample.saturated);
  EXPECT_EQ(sample.B_b_nt.x(), 1000.0);
  EXPECT_EQ(std::remainder(sample.B_b_nt.y(), 150.0), 0.0);
  EXPECT_EQ(sample.B_b_nt.z(), earth_n_nt().z());
}

TEST(Magnetometer, AFaultActsWhileItIsOn) {
  MagnetometerModel model(setup());
  const Vector3 before = model.observe(truth_at(1))->B_b_nt;
  model.apply(fault([](FaultProfile& f) {
    f.magnetic_jump_nt = {500.0, 0.0, 0.0};
    f.magnetometer_axes[1] = AxisFault::Stuck;
    f.magnetometer_axes[2] = AxisFault::SignFlip;
  }));
  const Vector3 during = model.observe(truth_at(2, {0.0, 0.0, 0.3}))->B_b_nt;
  EXPECT_EQ(during.y(), before.y());
  EXPECT_NEAR(during.z(), -before.z(), 1e-6);
  model.apply(fault([](FaultProfile& f) { f.magnetometer_silent = true; }));
  EXPECT_FALSE(model.observe(truth_at(3)).has_value());
  model.apply(fault([](FaultProfile&) {}));
  const auto after = model.observe(truth_at(4));
  EXPECT_EQ(after->B_b_nt, before);
  EXPECT_EQ(after->header.sequence_number, 2U);
}

TEST(Magnetometer, AnotherKindsFaultIsRefused) {
  MagnetometerModel model(setup());
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.outage = true; })), std::invalid_argument);
  EXPECT_THROW(model.apply(fault([](FaultProfile& f) { f.gyro_silent = true; })), std::invalid_argument);
}

TEST(Magnetometer, ASilentTimeChangesNoLaterDraw) {
  MagnetometerModel::Setup s = setup();
  s.errors.white_sigma_nt = Vector3::Constant(20.0);
  s.errors.gm_sigma_nt = Vector3::Constant(30.0);
  s.errors.gm_correlation_time_s = Vector3::Constant(5.0);
  MagnetometerModel heard(s), silent(s);
  silent.apply(fault([](FaultProfile& f) { f.magnetometer_silent = true; }));
  for (std::uint64_t k = 1; k <= 20; ++k) heard.observe(truth_at(k)), silent.observe(truth_at(k));
  silent.apply(fault([](FaultProfile&) {}));
  EXPECT_EQ(heard.observe(truth_at(21))->B_b_nt, silent.observe(truth_at(21))->B_b_nt);
}

TEST(Magnetometer, ACarBesideTheWayIsFeltThroughTheLeverArm) {
  MagnetometerModel::Setup s = setup();
  s.installation.lever_arm_v_m = {2.0, 0.0, 0.0};
  MagneticBody car;
  car.latitude_deg = 0.53 / units::kDeg;
  car.longitude_deg = 1.996 / units::kDeg;
  car.height_m = 20.0;
  car.moment_ned_a_m2 = {0.0, 0.0, 200.0};
  MagnetometerModel alone(s);
  s.errors.bodies = {car};
  MagnetometerModel passing(s);
  const Vector3 felt = passing.observe(truth_at(1))->B_b_nt - alone.observe(truth_at(1))->B_b_nt;
  EXPECT_LT((felt - Vector3(0.0, 0.0, -100.0 * 200.0 / 8.0)).norm(), 0.01);  // beside its axis
}

}  // namespace model_test
}  // namespace inslab::magnetometer
