#include "inslab/models/navigation/magnetic_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "inslab/models/navigation/matching_magnetometer.hpp"
#include "tests/unit/models/navigation/drawn_run.hpp"

namespace inslab::navigation {
namespace magnetic_vector_test {

using namespace circling;

constexpr std::uint32_t kWeek = 2446;  // late in 2026

MagneticField field_at(const Circling& truth, const Vector3& hard_iron_nt, const Matrix3& C_mb = Matrix3::Identity()) {
  MagneticField sample;
  sample.header.sim_time_ns = truth.time_ns();
  sample.header.gps_week = kWeek;
  sample.header.gps_time_of_week_ns = truth.time_ns();
  const nav::NavState now = truth.state();
  const nav::WorldMagneticModel earth(time::decimal_year({kWeek, truth.time_ns()}));
  sample.B_b_nt = C_mb * nav::matrix_from_quaternion(now.q_nb).transpose() * earth.B_n_nt(now.position) + hard_iron_nt;
  return sample;
}

NavigationParameters told() {
  NavigationParameters p;
  p.states.hard_iron = true;
  p.magnetometer.white_sigma_nt.setConstant(50.0);
  p.magnetometer.hard_iron_sigma_nt.setConstant(400.0);
  return p;
}

// Central differences of step h err by the third derivative times h^2/6: of 5e4 nT and h = 1e-4, some 1e-4 nT.
TEST(MagneticVector, ItsDerivativesAreThoseOfWhatItPredicts) {
  NavigationParameters p = told();
  p.states.soft_iron = p.states.earth_field = true;
  p.magnetometer.mounting_rpy_deg = Vector3(20.0, -30.0, 110.0);
  const StateLayout layout(p.states);
  Situation at;
  at.position = {0.8, 0.2, 300.0};
  at.C_nb = nav::matrix_from_rpy({0.3, -0.4, 2.0});
  at.estimates[StateBlock::HardIron] = Vector3(100.0, -200.0, 300.0);
  at.estimates[StateBlock::SoftIronX] = Vector3(0.02, 0.01, -0.03);
  at.estimates[StateBlock::SoftIronZ] = Vector3(-0.01, 0.03, 0.02);
  at.estimates[StateBlock::EarthField] = Vector3(500.0, -300.0, 100.0);
  MagneticField sample;
  sample.header.gps_week = kWeek;
  const auto innovation = [&](const Situation& situation) {
    std::vector<Measurement> made;
    MagneticVector::add_to(made, sample, situation, p);
    return Vector3(made.front().innovation);
  };
  std::vector<Measurement> made;
  MagneticVector::add_to(made, sample, at, p);
  const auto H = made.front().H(layout);
  for (Eigen::Index i = kAttitude; i < layout.size(); ++i) {
    const double h = i >= layout.first(StateBlock::HardIron) && i < layout.first(StateBlock::SoftIronX) ? 1.0 : 1e-4;
    StateVector x = StateVector::Zero(layout.size());
    x[i] = h;
    const Vector3 slope = (innovation(erring(at, x, layout)) - innovation(erring(at, -x, layout))) / (2.0 * h);
    EXPECT_LT((slope - H.col(i)).norm(), 1e-3) << "state " << i;
  }
}

TEST(MagneticVector, FindsAHeadingAndAHardIronThatNobodyToldItOf) {
  const NavigationParameters p = told();
  const Vector3 hard_iron_nt(300.0, -500.0, 200.0);
  Circling truth;
  NavigationFilter filter(p, kGravity);
  nav::NavState wrong = truth.state();
  wrong.q_nb = nav::quaternion_from_rpy({0.0, 0.0, 2.0 * units::kDeg});
  filter.start(wrong, 0);
  for (int k = 0; k < 16000; ++k) {
    filter.add(truth.next());
    if (k % 20 == 19) filter.add(field_at(truth, hard_iron_nt));
  }
  const InertialFilter& now = *filter.filter();
  EXPECT_LT((now.estimates()[StateBlock::HardIron] - hard_iron_nt).norm(), 20.0);
  const nav::Quaternion off = now.state().q_nb * truth.state().q_nb.conjugate();
  EXPECT_LT(std::abs(2.0 * off.z()) / units::kDeg, 0.1);
}

// Steel beside the road: 5000 nT, of which 50 nT of noise and a hard iron of 400 nT know nothing.
TEST(MagneticVector, WhatTheInnovationTestRefusesChangesNothing) {
  const NavigationParameters p = told();
  Circling truth, twin;
  NavigationFilter disturbed = begun(truth, p), undisturbed = begun(twin, p);
  for (int k = 0; k < 4000; ++k) {
    disturbed.add(truth.next());
    undisturbed.add(twin.next());
    if (is_fix_time(truth)) disturbed.add(truth.fix());
    if (is_fix_time(twin)) undisturbed.add(twin.fix());
    if (k % 20 != 19) continue;
    const bool beside_steel = k > 2000 && k < 3000;
    if (!beside_steel) undisturbed.add(field_at(twin, Vector3::Zero()));
    disturbed.add(field_at(truth, beside_steel ? Vector3(0.0, 5000.0, 0.0) : Vector3::Zero()));
  }
  std::size_t refused = 0;
  for (const UpdateResult& result : disturbed.take_results()) {
    const MeasurementResult* magnetic = result.of("magnetic_vector");
    refused += magnetic != nullptr && !magnetic->accepted ? 1 : 0;
  }
  EXPECT_EQ(refused, 50U);
  EXPECT_LT((disturbed.filter()->state().q_nb.coeffs() - undisturbed.filter()->state().q_nb.coeffs()).norm(), 1e-6);
}

TEST(MagneticVector, OfOneTimeTheOrderInWhichStreamsComeDoesNotMatter) {
  const NavigationParameters p = told();
  Circling truth;
  NavigationFilter first = begun(truth, p), other = first;
  for (int k = 0; k < 2000; ++k) {
    const ImuSample sample = truth.next();
    first.add(sample);
    other.add(sample);
    if (!is_fix_time(truth)) continue;
    const Vector3 off(k % 3 == 0 ? 40.0 : -30.0, 20.0, 0.0);
    first.add(truth.fix());
    first.add(field_at(truth, off));
    other.add(field_at(truth, off));
    other.add(truth.fix());
  }
  EXPECT_EQ(first.filter()->covariance().matrix(), other.filter()->covariance().matrix());
  EXPECT_EQ(first.filter()->state().q_nb.coeffs(), other.filter()->state().q_nb.coeffs());
}

TEST(MagneticVector, SaturatedSamplesAndThoseWithoutANumberAreNotUsed) {
  MagneticField sample;
  EXPECT_TRUE(MagneticVector::usable(sample));
  sample.saturated = true;
  EXPECT_FALSE(MagneticVector::usable(sample));
  sample.saturated = false;
  sample.B_b_nt.y() = std::nan("");
  EXPECT_FALSE(MagneticVector::usable(sample));
}

TEST(MagneticVector, ItsParametersMatchAProfileAndChooseWhatThereIsToEstimate) {
  MagnetometerErrorProfile errors;
  errors.white_sigma_nt.setConstant(12.0);
  errors.quantization_nt.setConstant(std::sqrt(12.0) * 5.0);
  NavigationParameters p;
  InstallationProfile place, imu_place;
  place.mounting_rpy_deg = Vector3(0.0, 0.0, 100.0);
  imu_place.mounting_rpy_deg = Vector3(0.0, 0.0, 30.0);
  match(errors, place, imu_place, p);
  EXPECT_NEAR(p.magnetometer.white_sigma_nt.x(), 13.0, 1e-12);
  EXPECT_LT((p.magnetometer.mounting_rpy_deg - Vector3(0.0, 0.0, 70.0)).norm(), 1e-12);
  EXPECT_FALSE(p.states.hard_iron || p.states.soft_iron || p.states.earth_field);
  errors.hard_iron_nt = Vector3(30.0, 0.0, 0.0);
  errors.gm_sigma_nt = Vector3(40.0, 0.0, 0.0);
  errors.gm_correlation_time_s = Vector3(600.0, 0.0, 0.0);
  errors.currents = {{0.0, Vector3::Zero()}, {1.0, Vector3(0.0, -70.0, 0.0)}};
  errors.soft_iron[1] = -0.01;
  match(errors, place, imu_place, p);
  EXPECT_EQ(p.magnetometer.hard_iron_sigma_nt, Vector3(50.0, 70.0, 0.0));
  EXPECT_EQ(p.magnetometer.hard_iron_correlation_time_s, Vector3(600.0, 0.0, 0.0));
  EXPECT_EQ(p.magnetometer.soft_iron_sigma[1], 0.01);
  EXPECT_TRUE(p.states.hard_iron && p.states.soft_iron);
}

double nees_of_run(std::uint64_t seed) {
  DrawnRun run(told(), seed, "magnetic_vector_test");
  const Vector3 hard_iron_nt = -run.of(StateBlock::HardIron);
  for (int k = 0; k < 8000; ++k) {
    run.advance();
    if (k < 4000) run.fix_if_due();
    if (k % 20 != 19) continue;
    const Vector3 noise_nt = run.parameters().magnetometer.white_sigma_nt.cwiseProduct(run.normals());
    run.filter().add(field_at(run.truth(), hard_iron_nt + noise_nt));
  }
  return run.nees();
}

// 40 s, of which the last 20 without fixes.
TEST(MagneticVector, IsHonestWithAHardIronOver100Runs) { expect_honest_over_100_runs(24, nees_of_run); }

}  // namespace magnetic_vector_test
}  // namespace inslab::navigation
