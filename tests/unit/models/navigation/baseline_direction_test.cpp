#include "inslab/models/navigation/baseline_direction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "inslab/models/navigation/matching_heading.hpp"
#include "tests/unit/models/navigation/drawn_run.hpp"

namespace inslab::navigation {
namespace baseline_direction_test {

using namespace circling;

const Vector3 kBaseline_b_m(1.5, 0.3, -0.2);

/// What a receiver shows whose second antenna is taken to be elsewhere by `off_n_m`.
BaselineHeading shown(const Matrix3& C_nb, std::int64_t time_ns, const Vector3& off_n_m = Vector3::Zero()) {
  const Vector3 b_n = C_nb * kBaseline_b_m + off_n_m;
  BaselineHeading sample;
  sample.header.sim_time_ns = time_ns;
  sample.fix_type = FixType::Fixed;
  sample.heading_rad = std::atan2(b_n.y(), b_n.x());
  sample.pitch_rad = std::asin(-b_n.z() / b_n.norm());
  sample.baseline_m = b_n.norm();
  return sample;
}
BaselineHeading shown_at(const Circling& truth, const Vector3& off_n_m = Vector3::Zero()) {
  return shown(nav::matrix_from_quaternion(truth.state().q_nb), truth.time_ns(), off_n_m);
}

NavigationParameters told() {
  NavigationParameters p;
  p.heading.baseline_b_m = kBaseline_b_m;
  p.heading.relative_sigma_ned_m = {0.004, 0.004, 0.008};
  p.heading.relative_drift_sigma_ned_m = {0.005, 0.005, 0.01};
  p.heading.relative_drift_correlation_time_s.setZero();
  p.states.baseline_drift = true;
  return p;
}

std::vector<Measurement> made_of(const BaselineHeading& sample, const Situation& at, const NavigationParameters& p) {
  std::vector<Measurement> made;
  BaselineDirection::add_to(made, sample, at, p);
  return made;
}

Situation tilted() {
  Situation at;
  at.position = {0.8, 0.2, 300.0};
  at.C_nb = nav::matrix_from_rpy({0.3, -0.4, 2.0});
  at.estimates[StateBlock::BaselineDrift] = Vector3(0.02, -0.03, 0.05);
  return at;
}

// Central differences of step h err by the third derivative times h^2/6: h is 1e-4 rad or m beside 1.5 m, some 1e-8.
TEST(BaselineDirection, ItsDerivativesAreThoseOfWhatItPredicts) {
  const NavigationParameters p = told();
  const StateLayout layout(p.states);
  const Situation at = tilted();
  const auto innovation = [&](const Situation& situation) {
    return Eigen::Vector2d(made_of(shown(at.C_nb, 0), situation, p).front().innovation);
  };
  const auto H = made_of(shown(at.C_nb, 0), at, p).front().H(layout);
  for (Eigen::Index i = 0; i < layout.size(); ++i) {
    constexpr double h = 1e-4;
    StateVector x = StateVector::Zero(layout.size());
    x[i] = h;
    const Eigen::Vector2d slope = (innovation(erring(at, x, layout)) - innovation(erring(at, -x, layout))) / (2.0 * h);
    EXPECT_LT((slope - H.col(i)).norm(), 1e-6) << "state " << i;
  }
}

// On a level baseline of 1 m, 5 mm across are 5 mrad, and 8 mm of height 8 mrad.
TEST(BaselineDirection, IsAsUnsureAsTheRelativePositionOverTheBaseline) {
  NavigationParameters p = told();
  p.heading.baseline_b_m = Vector3::UnitX();
  p.heading.relative_sigma_ned_m = {0.1, 0.005, 0.008};
  const Measurement m = made_of(shown(Matrix3::Identity(), 0), Situation{}, p).front();
  EXPECT_NEAR(std::sqrt(m.R[0]), 0.005, 1e-12);
  EXPECT_NEAR(std::sqrt(m.R[1]), 0.008, 1e-12);
}

TEST(BaselineDirection, GoesTheShortWayAcrossNorth) {
  NavigationParameters p = told();
  p.heading.baseline_b_m = Vector3::UnitX();
  BaselineHeading sample = shown(Matrix3::Identity(), 0);
  sample.heading_rad = 359.0 * units::kDeg;
  Situation at;
  at.C_nb = nav::matrix_from_rpy({0.0, 0.0, 1.0 * units::kDeg});
  EXPECT_NEAR(made_of(sample, at, p).front().innovation[0], 2.0 * units::kDeg, 1e-12);
}

TEST(BaselineDirection, IsNotMadeOfALesserSolutionNorWithoutABaseline) {
  NavigationParameters p = told();
  BaselineHeading sample = shown(Matrix3::Identity(), 0);
  EXPECT_EQ(made_of(sample, Situation{}, p).size(), 1U);
  sample.fix_type = FixType::Float;
  EXPECT_TRUE(made_of(sample, Situation{}, p).empty());
  sample.fix_type = FixType::Fixed;
  p.heading.baseline_b_m.setZero();
  EXPECT_TRUE(made_of(sample, Situation{}, p).empty());
  EXPECT_TRUE(BaselineDirection::usable(sample));
  sample.heading_rad = std::nan("");
  EXPECT_FALSE(BaselineDirection::usable(sample));
}

// At rest in all but its circle's turn, without one fix: 2 deg of yaw are found to what 0.4 deg of white noise leave in
// 5 s.
TEST(BaselineDirection, FindsAHeadingWithoutFixes) {
  NavigationParameters p = told();
  p.states.baseline_drift = false;
  Circling truth;
  NavigationFilter filter(p, kGravity);
  nav::NavState wrong = truth.state();
  wrong.q_nb = nav::quaternion_from_rpy({0.0, 0.0, 2.0 * units::kDeg});
  filter.start(wrong, 0);
  for (int k = 0; k < 1000; ++k) {
    filter.add(truth.next());
    if (k % 20 == 19) filter.add(shown_at(truth));
  }
  const nav::Quaternion off = filter.filter()->state().q_nb * truth.state().q_nb.conjugate();
  EXPECT_LT(std::abs(2.0 * off.z()) / units::kDeg, 0.02);
}

// A wavelength of L1 across 1.5 m is 7 deg, of which 0.2 deg of noise and a heading that is known by then know nothing.
TEST(BaselineDirection, AWrongFixIsRefusedAndChangesNothing) {
  const NavigationParameters p = told();
  Circling truth, twin;
  NavigationFilter disturbed = begun(truth, p), undisturbed = begun(twin, p);
  for (int k = 0; k < 4000; ++k) {
    disturbed.add(truth.next());
    undisturbed.add(twin.next());
    if (is_fix_time(truth)) disturbed.add(truth.fix());
    if (is_fix_time(twin)) undisturbed.add(twin.fix());
    if (k % 20 != 19) continue;
    const bool is_wrong = k > 2000 && k < 2400;
    if (!is_wrong) undisturbed.add(shown_at(twin));
    disturbed.add(shown_at(truth, is_wrong ? Vector3(0.1, 0.15, -0.06) : Vector3::Zero()));
  }
  std::size_t refused = 0;
  for (const UpdateResult& result : disturbed.take_results()) {
    const MeasurementResult* heading = result.of("baseline_direction");
    refused += heading != nullptr && !heading->accepted ? 1 : 0;
  }
  EXPECT_EQ(refused, 20U);
  EXPECT_LT((disturbed.filter()->state().q_nb.coeffs() - undisturbed.filter()->state().q_nb.coeffs()).norm(), 1e-6);
}

TEST(BaselineDirection, SamplesThatComeLateGiveTheSameBitsAsInTime) {
  const NavigationParameters p = told();
  Circling truth;
  NavigationFilter in_time = begun(truth, p), late = in_time;
  std::multimap<std::int64_t, BaselineHeading> on_their_way;
  std::int64_t count = 0;
  for (int k = 0; k < 2400; ++k) {
    const ImuSample sample = truth.next();
    in_time.add(sample);
    late.add(sample);
    if (k % 20 == 7 && k < 2200) {
      const BaselineHeading heading = shown_at(truth, Vector3(0.004 * std::sin(k), 0.004 * std::cos(k), 0.0));
      in_time.add(heading);
      on_their_way.emplace(truth.time_ns() + 110'000'000 + 150'000'000 * (3 * count++ % 5), heading);
    }
    while (!on_their_way.empty() && on_their_way.begin()->first <= truth.time_ns()) {
      late.add(on_their_way.begin()->second);
      on_their_way.erase(on_their_way.begin());
    }
  }
  EXPECT_EQ(in_time.filter()->covariance().matrix(), late.filter()->covariance().matrix());
  EXPECT_EQ(in_time.filter()->state().q_nb.coeffs(), late.filter()->state().q_nb.coeffs());
  EXPECT_EQ(late.counts().fixes_too_old, 0U);
}

TEST(BaselineDirection, IsToldTheNominalArmsInTheAxesOfTheImuAndTheErrorsOfTheProfile) {
  HeadingErrorProfile errors;
  errors.relative_sigma_ned_m = {0.001, 0.002, 0.003};
  InstallationProfile place, imu_place;
  place.lever_arm_v_m = {1.0, 0.0, -1.0};
  place.second_lever_arm_v_m = {1.0, 2.0, -1.0};
  imu_place.mounting_rpy_deg = {0.0, 0.0, 90.0};  // its x looks to the right
  NavigationParameters p;
  match(errors, place, imu_place, p);
  EXPECT_LT((p.heading.baseline_b_m - Vector3(2.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(p.heading.relative_sigma_ned_m, Vector3(0.001, 0.002, 0.003));
  EXPECT_FALSE(p.states.baseline_drift);
  errors.relative_gm_sigma_ned_m = {0.004, 0.005, 0.006};
  errors.relative_gm_correlation_time_s.setConstant(60.0);
  match(errors, place, imu_place, p);
  EXPECT_TRUE(p.states.baseline_drift);
  EXPECT_EQ(p.heading.relative_drift_sigma_ned_m, Vector3(0.004, 0.005, 0.006));
  EXPECT_EQ(p.heading.relative_drift_correlation_time_s, Vector3::Constant(60.0));
}

double nees_of_run(std::uint64_t seed) {
  DrawnRun run(told(), seed, "baseline_direction_test");
  const Vector3 drift_n_m = -run.of(StateBlock::BaselineDrift);
  for (int k = 0; k < 8000; ++k) {
    run.advance();
    if (k < 4000) run.fix_if_due();
    if (k % 20 != 19) continue;
    const Vector3 noise_n_m = run.parameters().heading.relative_sigma_ned_m.cwiseProduct(run.normals());
    run.filter().add(shown_at(run.truth(), drift_n_m + noise_n_m));
  }
  return run.nees();
}

// 40 s, of which the last 20 without fixes.
TEST(BaselineDirection, IsHonestWithAnErrorThatLastsOver100Runs) { expect_honest_over_100_runs(24, nees_of_run); }

}  // namespace baseline_direction_test
}  // namespace inslab::navigation
