#include <gtest/gtest.h>

#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/models/gnss/receiver.hpp"

/// Gauss-Markov errors, kinds of solution, areas without signals, satellites and drifts of the whole receiver.
namespace inslab::gnss {
namespace solution_test {

using namespace test;

TEST(GnssModel, GivesFixesAtEveryRateFrom1To50Hz) {
  for (const double hz : {1.0, 2.0, 5.0, 10.0, 20.0, 25.0, 40.0, 50.0}) {
    const auto fixes = run(GnssModel(setup(hz)), 3.0);
    EXPECT_EQ(fixes.size(), static_cast<std::size_t>(3.0 * hz)) << hz;
  }
}

/// A receiver with Gauss-Markov errors alone: T is ten epochs.
GnssModel::Setup wandering() {
  GnssModel::Setup s = setup(200.0);
  s.errors.position_gm_sigma_ned_m = {1.0, 2.0, 4.0};
  s.errors.position_gm_correlation_time_s.setConstant(0.05);
  s.errors.velocity_gm_sigma_ned_m_per_s = {0.1, 0.2, 0.3};
  s.errors.velocity_gm_correlation_time_s.setConstant(0.05);
  return s;
}

std::vector<Vector3> position_errors(const std::vector<GnssFix>& fixes) {
  std::vector<Vector3> errors;
  for (const GnssFix& fix : fixes) errors.push_back(position_error_ned(fix, at_rest(fix.header.sim_time_ns)));
  return errors;
}

TEST(GnssModel, GaussMarkovErrorsHaveTheirSigmasAndFallByEInACorrelationTime) {
  // N epochs of correlation p = exp(-1/10) stand for N (1 - p^2)/(1 + p^2) independent squares: 1000 of 10000, so the
  // mean square has the relative standard error sqrt(2/1000), and so, in sigma^2, have the products at a lag at most.
  const auto fixes = run(GnssModel(wandering()), 50.0);
  const std::vector<Vector3> errors = position_errors(fixes);
  const auto count = static_cast<double>(errors.size());
  Vector3 square = Vector3::Zero(), at_lag = Vector3::Zero(), velocity_square = Vector3::Zero();
  for (std::size_t k = 0; k < errors.size(); ++k) {
    square += errors[k].cwiseAbs2() / count;
    velocity_square += fixes[k].v_n.cwiseAbs2() / count;
    if (k >= 10) at_lag += errors[k].cwiseProduct(errors[k - 10]) / (count - 10.0);
  }
  const double bound = 4.0 * std::sqrt(2.0 / 1000.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double variance = std::pow(wandering().errors.position_gm_sigma_ned_m[axis], 2);
    const double velocity_variance = std::pow(wandering().errors.velocity_gm_sigma_ned_m_per_s[axis], 2);
    EXPECT_NEAR(square[axis], variance, bound * variance);
    EXPECT_NEAR(at_lag[axis], std::exp(-1.0) * variance, bound * variance);
    EXPECT_NEAR(velocity_square[axis], velocity_variance, bound * velocity_variance);
  }
}

TEST(GnssModel, WhiteAndGaussMarkovErrorsAddUpAndChangeNothingOfEachOther) {
  GnssModel::Setup white = setup(200.0), both = wandering();
  white.errors.position_sigma_ned_m.setConstant(3.0);
  both.errors.position_sigma_ned_m.setConstant(3.0);
  const auto of_white = position_errors(run(GnssModel(white), 1.0)),
             of_gm = position_errors(run(GnssModel(wandering()), 1.0));
  const auto fixes = run(GnssModel(both), 1.0);
  const auto sum = position_errors(fixes);
  // Each is good to the rounding of the angles, 1.4e-9 m.
  for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_LT((sum[k] - of_white[k] - of_gm[k]).norm(), 1e-8) << k;
  EXPECT_LT((fixes[0].position_sigma_ned_m - Vector3(std::sqrt(10.0), std::sqrt(13.0), 5.0)).norm(), 1e-15);
  EXPECT_EQ(fixes[0].velocity_sigma_ned_m_per_s, wandering().errors.velocity_gm_sigma_ned_m_per_s);
}

TEST(GnssModel, ASwapKeepsResetsOrRedrawsTheGaussMarkovStates) {
  const auto after_a_swap = [](Continuity continuity) {
    GnssModel::Setup s = wandering();
    s.errors.position_gm_correlation_time_s.setConstant(1e6);
    GnssModel model(s);
    const auto before = model.observe(at_rest(kTruthNs));
    GnssErrorProfile doubled = s.errors;
    doubled.position_gm_sigma_ned_m *= 2.0;
    doubled.request.continuity = continuity;
    model.apply(doubled);
    const auto after = model.observe(at_rest(2 * kTruthNs));
    return std::pair(position_error_ned(*before, at_rest(0)), position_error_ned(*after, at_rest(0)));
  };
  // In an epoch of 5 ms of T = 1e6 s a state moves by sigma sqrt(2 dt/T) = 1e-4 of its sigma.
  const auto kept = after_a_swap(Continuity::Keep);
  EXPECT_LT((kept.second - 2.0 * kept.first).norm(), 5e-3);
  EXPECT_LT(after_a_swap(Continuity::Reset).second.norm(), 5e-3);
  const auto redrawn = after_a_swap(Continuity::Redraw);
  EXPECT_GT((redrawn.second - 2.0 * redrawn.first).norm(), 0.1);
  EXPECT_GT(redrawn.second.norm(), 0.1);
}

/// Fixed, with a float rung of 1 s below it, which an outage at 1 s leads to.
GnssModel::Setup with_a_ladder() {
  GnssModel::Setup s = setup(10.0);
  s.errors.fix_type = FixType::Fixed;
  s.errors.position_sigma_ned_m.setConstant(0.01);
  LesserSolution none, floating;
  none.lasts_s = 0.5;
  floating.fix_type = FixType::Float;
  floating.lasts_s = 1.0;
  floating.position_sigma_ned_m.setConstant(1.0);
  floating.velocity_sigma_ned_m_per_s.setConstant(0.1);
  s.errors.lesser_solutions = {none, floating};
  s.outages = {{0.95, 0.1, 0.0}};
  return s;
}

TEST(GnssModel, ReportsEachKindOfSolutionWithItsOwnErrors) {
  const auto fixes = run(GnssModel(with_a_ladder()), 4.0);
  ASSERT_EQ(fixes.size(), 34U);  // without 1.0 s and, before there is a fix again, 1.1 to 1.5 s
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    EXPECT_EQ(fixes[i].header.sequence_number, i);
    const double t = time::to_seconds(fixes[i].header.sim_time_ns);
    const bool floating = t > 1.59 && t < 2.59;
    EXPECT_EQ(fixes[i].fix_type, floating ? FixType::Float : FixType::Fixed) << t;
    EXPECT_EQ(fixes[i].position_sigma_ned_m, Vector3::Constant(floating ? 1.0 : 0.01)) << t;
    EXPECT_EQ(fixes[i].velocity_sigma_ned_m_per_s, Vector3::Constant(floating ? 0.1 : 0.0)) << t;
    // |sum of three squares| of either: the larger sigma shows at once.
    const double error_m = position_error_ned(fixes[i], at_rest(fixes[i].header.sim_time_ns)).norm();
    EXPECT_LT(error_m, floating ? 10.0 : 0.1) << t;
    EXPECT_GT(error_m, floating ? 0.1 : 0.0) << t;
  }
}

TEST(GnssModel, HasNoFixWhileTheAntennaIsInATunnel) {
  // North at 10 m/s from 30 deg; the arm puts the antenna 2 m ahead, the tunnel is 40 to 60 m up the road.
  GnssModel::Setup s = setup(10.0);
  s.installation.lever_arm_v_m = {2.0, 0.0, 0.0};
  const auto road = [](double north_m) { return nav::displaced({30.0 * units::kDeg, 0.3, 0.0}, {north_m, 0.0, 0.0}); };
  const auto degrees = [](const nav::Geodetic& place) {
    return GroundPoint{place.latitude_rad / units::kDeg, place.longitude_rad / units::kDeg};
  };
  s.outage_areas = {{"tunnel", 5.0, {degrees(road(45.0)), degrees(road(55.0))}}};
  GnssModel model(s);
  for (std::int64_t k = 1; k <= 100; ++k) {
    TruthState truth = at_rest(k * 100'000'000);
    const nav::Geodetic place = road(static_cast<double>(k));
    truth.latitude_rad = place.latitude_rad;
    truth.longitude_rad = place.longitude_rad;
    truth.height_m = place.height_m;
    const bool inside = k + 2 >= 41 && k + 2 <= 59;
    if (k + 2 == 40 || k + 2 == 60) continue;  // the wall itself is a matter of rounding
    EXPECT_EQ(model.observe(truth).has_value(), !inside) << k;
  }
}

TEST(GnssModel, CountsSatellitesAndDopsOfItsConstellation) {
  GnssModel::Setup s = setup();
  s.errors.satellite_model = SatelliteModel::Gps;
  s.errors.elevation_mask_deg = 5.0;
  TruthState truth = at_rest(200000000);
  truth.header.gps_week = 2446;
  const auto fix = GnssModel(s).observe(truth);
  const Geometry sky =
      geometry_of(geodetic_of(truth), satellites_e_m(SatelliteModel::Gps, {2446, 0}), 5.0 * units::kDeg);
  ASSERT_GE(sky.satellites, 4U);
  EXPECT_EQ(fix->satellites_used, sky.satellites);
  EXPECT_EQ(fix->hdop, sky.hdop);
  EXPECT_EQ(fix->vdop, sky.vdop);
  EXPECT_EQ(fix->pdop, std::hypot(sky.hdop, sky.vdop));
  s.errors.elevation_mask_deg = 80.0;
  EXPECT_FALSE(GnssModel(s).observe(truth).has_value()) << "fewer than four satellites stand above 80 deg";
}

TEST(GnssModel, ADriftGrowsFromTheTimeTheFaultTakesEffect) {
  FaultProfile fault;
  fault.target.kind = SensorKind::Gnss;
  fault.position_drift_ned_m_per_s = {0.5, -0.25, 0.1};
  fault.request.apply_at_ns = 3'000'000'000;
  GnssModel model(setup());
  model.apply(fault);
  const auto fix = model.observe(at_rest(7'000'000'000));
  EXPECT_LT((position_error_ned(*fix, at_rest(0)) - Vector3(2.0, -1.0, 0.4)).norm(), 5e-9);
  EXPECT_TRUE(fix->v_n.isZero(1e-12)) << "a spoofer that forgets the Doppler shift";
}

TEST(GnssModel, AConsistentDriftShowsInTheVelocityToo) {
  FaultProfile fault;
  fault.target.kind = SensorKind::Gnss;
  fault.position_drift_ned_m_per_s = {0.5, -0.25, 0.1};
  fault.velocity_jump_ned_m_per_s = {0.0, 0.0, 1.0};
  fault.drift_in_velocity = true;
  GnssModel model(setup());
  model.apply(fault);
  EXPECT_LT((model.observe(at_rest(200000000))->v_n - Vector3(0.5, -0.25, 1.1)).norm(), 1e-12);
}

TEST(GnssModel, ADriftEndsAt100Km) {
  FaultProfile fault;
  fault.target.kind = SensorKind::Gnss;
  fault.position_drift_ned_m_per_s = {300.0, 400.0, 0.0};
  GnssModel model(setup());
  model.apply(fault);
  const auto fix = model.observe(at_rest(3600'000'000'000));
  EXPECT_LT((position_error_ned(*fix, at_rest(0)) - Vector3(60000.0, 80000.0, 0.0)).norm(), 1e-7);
}

}  // namespace solution_test
}  // namespace inslab::gnss
