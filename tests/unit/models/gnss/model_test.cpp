#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/models/gnss/receiver.hpp"

namespace inslab::gnss {
namespace model_test {

using namespace test;

TEST(GnssModel, FirstFixComesAfterOnePeriodAndNoneBetweenEpochs) {
  const auto fixes = run(GnssModel(setup()), 2.0);
  ASSERT_EQ(fixes.size(), 10U);
  for (std::size_t k = 0; k < fixes.size(); ++k) {
    EXPECT_EQ(fixes[k].header.sim_time_ns, static_cast<std::int64_t>(k + 1) * 200000000);
    EXPECT_EQ(fixes[k].header.sequence_number, k);
  }
}

TEST(GnssModel, AntennaIsTheRotatedArmAwayInAnyAttitude) {
  // Promised: 1e-6 m. Reference: ECEF of the vehicle plus C_en C_nv l, whose rounding is 2e-9 m.
  GnssModel::Setup s = setup(200.0);
  s.installation.lever_arm_v_m = {0.5, -0.3, -1.5};
  GnssModel model(s);
  std::int64_t k = 0;
  for (double roll = -180.0; roll <= 180.0; roll += 45.0) {
    for (double pitch = -90.0; pitch <= 90.0; pitch += 30.0) {
      for (double yaw = 0.0; yaw < 360.0; yaw += 60.0) {
        const nav::RollPitchYaw rpy{roll * units::kDeg, pitch * units::kDeg, yaw * units::kDeg};
        TruthState truth = at_rest(++k * kTruthNs);
        truth.q_nv = nav::quaternion_from_rpy(rpy);
        const auto fix = model.observe(truth);
        ASSERT_TRUE(fix.has_value());
        const nav::Geodetic vehicle = geodetic_of(truth);
        const Vector3 expected_e =
            nav::ecef_from_geodetic(vehicle) + nav::C_en(vehicle.latitude_rad, vehicle.longitude_rad) *
                                                   (nav::matrix_from_rpy(rpy) * s.installation.lever_arm_v_m);
        const Vector3 antenna_e = nav::ecef_from_geodetic(geodetic_of(*fix));
        EXPECT_LT((antenna_e - expected_e).norm(), 5e-9) << roll << ' ' << pitch << ' ' << yaw;
      }
    }
  }
}

TEST(GnssModel, VelocityIsTheDerivativeOfTheAntennasPosition) {
  // Five-point derivative over h = 5 ms of a circle of radius l <= 1.7 m at 1.5 rad/s: error l w^5 h^4/30 = 3e-10 m/s;
  // positions are rounded at 1e-9 m, and the formula's weights make 1.5 * 1e-9/h = 3e-7 m/s of it.
  GnssModel::Setup s = setup(200.0);
  s.installation.lever_arm_v_m = {0.5, -0.3, -1.5};
  GnssModel model(s);
  const Vector3 rate_v(0.7, -0.9, 1.0);
  const Quaternion start = nav::quaternion_from_rpy({0.3, -0.4, 2.0});
  std::vector<GnssFix> fixes;
  for (std::int64_t k = 1; k <= 400; ++k) fixes.push_back(*model.observe(spinning(k * kTruthNs, rate_v, start)));
  const auto r_e = [&](std::size_t k) { return nav::ecef_from_geodetic(geodetic_of(fixes[k])); };
  for (std::size_t k = 2; k + 2 < fixes.size(); ++k) {
    const Vector3 derivative_e = (8.0 * (r_e(k + 1) - r_e(k - 1)) - (r_e(k + 2) - r_e(k - 2))) / (12.0 * 5e-3);
    const Matrix3 C_en = nav::C_en(fixes[k].latitude_rad, fixes[k].longitude_rad);
    EXPECT_LT((C_en * fixes[k].v_n - derivative_e).norm(), 1e-6) << k;
  }
}

TEST(GnssModel, VelocityIsGivenInTheAntennasOwnNed) {
  // 1 km east of a vehicle that flies north at 250 m/s at 60 deg latitude, NED is turned about the vertical by
  // l tan(lat)/(N + h) = 2.7e-4 rad, so 0.068 m/s go east; the speed stays.
  GnssModel::Setup s = setup();
  s.installation.lever_arm_v_m = {0.0, 1000.0, 0.0};
  GnssModel model(s);
  TruthState truth = at_rest(200000000);
  truth.latitude_rad = 60.0 * units::kDeg;
  truth.v_n = {250.0, 0.0, 0.0};
  truth.omega_iv_v = nav::omega_ie_n(truth.latitude_rad);
  const auto fix = model.observe(truth);
  const double N = nav::wgs84::transverse_radius_m(truth.latitude_rad);
  const double convergence = 1000.0 * std::tan(truth.latitude_rad) / (N + truth.height_m);
  // Meridians converge towards the pole: the antenna's north leans west of the vehicle's.
  EXPECT_NEAR(fix->v_n.y(), 250.0 * convergence, 250.0 * convergence * convergence);
  EXPECT_NEAR(fix->v_n.norm(), 250.0, 1e-12);
}

TEST(GnssModel, ErrorsHaveTheirSigmasInNed) {
  // N epochs: the sample variance has relative standard error sqrt(2/N) = 2 %, the mean sigma/sqrt(N).
  GnssModel::Setup s = setup(200.0);
  s.errors.position_sigma_ned_m = {1.0, 2.0, 4.0};
  s.errors.velocity_sigma_ned_m_per_s = {0.1, 0.2, 0.3};
  const auto fixes = run(GnssModel(s), 25.0);
  const auto count = static_cast<double>(fixes.size());
  ASSERT_EQ(fixes.size(), 5000U);
  Vector3 mean = Vector3::Zero(), square = Vector3::Zero(), velocity_square = Vector3::Zero();
  for (const GnssFix& fix : fixes) {
    const Vector3 error = position_error_ned(fix, at_rest(fix.header.sim_time_ns));
    mean += error / count;
    square += error.cwiseAbs2() / count;
    velocity_square += fix.v_n.cwiseAbs2() / count;
    EXPECT_EQ(fix.position_sigma_ned_m, s.errors.position_sigma_ned_m);
    EXPECT_EQ(fix.velocity_sigma_ned_m_per_s, s.errors.velocity_sigma_ned_m_per_s);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double variance = std::pow(s.errors.position_sigma_ned_m[axis], 2);
    const double velocity_variance = std::pow(s.errors.velocity_sigma_ned_m_per_s[axis], 2);
    EXPECT_NEAR(square[axis], variance, 4.0 * std::sqrt(2.0 / count) * variance);
    EXPECT_NEAR(mean[axis], 0.0, 4.0 * std::sqrt(variance / count));
    EXPECT_NEAR(velocity_square[axis], velocity_variance, 4.0 * std::sqrt(2.0 / count) * velocity_variance);
  }
}

TEST(GnssModel, AJumpMovesTheFixByItsNedMetres) {
  GnssModel model(setup());
  FaultProfile fault;
  fault.target.kind = SensorKind::Gnss;
  fault.position_jump_ned_m = {30.0, -40.0, 5.0};
  fault.request.journal_number = 4;
  model.apply(fault);
  const auto fix = model.observe(at_rest(200000000));
  // ned_from() is good to the rounding of the angles, 2.2e-16 * 6.4e6 m.
  EXPECT_LT((position_error_ned(*fix, at_rest(200000000)) - fault.position_jump_ned_m).norm(), 5e-9);
  EXPECT_EQ(fix->revisions.fault, 4U);
}

GnssModel::Setup noisy() {
  GnssModel::Setup s = setup();
  s.errors.position_sigma_ned_m.setConstant(1.0);
  s.errors.velocity_sigma_ned_m_per_s.setConstant(0.1);
  return s;
}

TEST(GnssModel, AnOutagePublishesNothingAndChangesNoOtherFix) {
  GnssModel::Setup with_outage = noisy();
  with_outage.outages = {{2.0, 1.0, 0.0}, {5.0, 0.2, 0.0}};
  const auto all = run(GnssModel(noisy()), 10.0), some = run(GnssModel(with_outage), 10.0);
  ASSERT_EQ(all.size(), 50U);
  ASSERT_EQ(some.size(), 44U);  // without 2.0, 2.2 .. 2.8 and 5.0 s
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].header.sequence_number, i);
    const double t = time::to_seconds(some[i].header.sim_time_ns);
    EXPECT_FALSE((t > 1.999 && t < 2.999) || (t > 4.999 && t < 5.199)) << t;
    const auto epoch = static_cast<std::size_t>(some[i].header.sim_time_ns / 200000000);
    EXPECT_EQ(some[i].latitude_rad, all[epoch - 1].latitude_rad);
    EXPECT_EQ(some[i].v_n, all[epoch - 1].v_n);
  }
}

TEST(GnssModel, TheOutageFaultSilencesTheReceiverWhileItIsOn) {
  GnssModel model(noisy());
  FaultProfile fault, over;
  fault.target.kind = over.target.kind = SensorKind::Gnss;
  fault.outage = true;
  model.apply(fault);
  EXPECT_FALSE(model.observe(at_rest(200000000)).has_value());
  model.apply(over);
  const auto fix = model.observe(at_rest(400000000));
  ASSERT_TRUE(fix.has_value());
  EXPECT_EQ(fix->header.sequence_number, 0U);
  EXPECT_EQ(fix->v_n, run(GnssModel(noisy()), 0.4)[1].v_n);
}

TEST(GnssModel, EveryReceiverSeedAndAxisHasItsOwnNoise) {
  GnssModel::Setup other_seed = noisy(), other_number = noisy();
  other_seed.seed = 43;
  other_number.sensor_number = 1;
  const GnssFix fix = run(GnssModel(noisy()), 0.2)[0];
  EXPECT_NE(fix.v_n, run(GnssModel(other_seed), 0.2)[0].v_n);
  EXPECT_NE(fix.v_n, run(GnssModel(other_number), 0.2)[0].v_n);
  EXPECT_NE(fix.v_n.x(), fix.v_n.y());
  EXPECT_EQ(fix.v_n, run(GnssModel(noisy()), 0.2)[0].v_n);
}

TEST(GnssModel, ReportsWhatTheProfileSays) {
  GnssModel::Setup s = setup();
  s.errors.fix_type = FixType::Fixed;
  s.errors.latency_s = 0.05;
  s.errors.satellites = 17;
  s.errors.hdop = 0.6;
  s.errors.vdop = 0.8;
  s.sensor_number = 3;
  const GnssFix fix = run(GnssModel(s), 0.2)[0];
  EXPECT_EQ(fix.sensor_number, 3U);
  EXPECT_EQ(fix.fix_type, FixType::Fixed);
  EXPECT_EQ(fix.available_sim_time_ns, 250000000);
  EXPECT_EQ(fix.satellites_used, 17U);
  EXPECT_DOUBLE_EQ(fix.pdop, 1.0);
}

TEST(GnssModel, ASwapTakesEffectAtTheNextEpochAndScalesTheSameDraws) {
  GnssModel model(noisy());
  model.observe(at_rest(200000000));
  GnssErrorProfile worse = noisy().errors;
  worse.velocity_sigma_ned_m_per_s *= 2.0;
  worse.request.journal_number = 9;
  model.apply(worse);
  const auto fix = model.observe(at_rest(400000000));
  const GnssFix unswapped = run(GnssModel(noisy()), 0.4)[1];
  EXPECT_EQ(fix->v_n, 2.0 * unswapped.v_n);
  EXPECT_EQ(fix->revisions.gnss_error, 9U);
  EXPECT_EQ(unswapped.revisions.gnss_error, 0U);
}

TEST(GnssModel, RefusesWhatBreaksARule) {
  GnssModel model(setup());
  InstallationProfile for_an_imu;
  EXPECT_THROW(model.apply(for_an_imu), std::invalid_argument);
  GnssErrorProfile no_fix;
  no_fix.fix_type = FixType::None;
  EXPECT_THROW(model.apply(no_fix), std::invalid_argument);
  GnssModel::Setup negative = setup(), unknown = setup();
  negative.outages = {{1.0, -1.0, 0.0}};
  unknown.outages = {{std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0}};
  EXPECT_THROW(GnssModel{negative}, std::invalid_argument);
  EXPECT_THROW(GnssModel{unknown}, std::invalid_argument);
}

}  // namespace model_test
}  // namespace inslab::gnss
