#include "inslab/models/navigation/navigation_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "inslab/foundation/units/units.hpp"
#include "tests/unit/models/navigation/circling.hpp"

namespace inslab::navigation {
namespace navigation_filter_test {

using namespace circling;

TEST(NavigationFilter, FollowsAVehicleWithAnAntennaOnALeverArm) {
  NavigationParameters p;
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  Circling truth;
  NavigationFilter filter = begun(truth, p);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 6000; ++k) {
    solution = filter.add(truth.next());
    if (is_fix_time(truth)) filter.add(truth.fix(p.lever_arm_b_m));
  }
  // No errors anywhere: what is left is rounding and the second order of one rate a sample in the antenna's velocity.
  EXPECT_LT(error_m(*solution, truth), 1e-4);
  EXPECT_EQ(solution->mode, NavMode::Navigating);
  EXPECT_EQ(solution->imu_sequence, 5999U);
}

TEST(NavigationFilter, RefusesASpoofedPositionAndGoesOn) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 20.0, 0.0);
  filter.take_results();
  const NavSolution solution = run(filter, truth, 2.0, 50.0);
  for (const UpdateResult& result : filter.take_results()) EXPECT_FALSE(result.of("gnss_position")->accepted);
  EXPECT_LT(error_m(solution, truth), 0.05);
}

TEST(NavigationFilter, BelievesTheReceiverAfterManyRefusalsInARow) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 20.0, 0.0);
  filter.take_results();
  const NavSolution solution = run(filter, truth, 10.0, 50.0);
  std::size_t recovered = 0, refused_before = 0;
  for (const UpdateResult& result : filter.take_results()) {
    recovered += result.recovered ? 1 : 0;
    refused_before += recovered == 0 ? 1 : 0;
  }
  EXPECT_EQ(refused_before, InnovationTest{}.rejections_before_recovery);
  EXPECT_EQ(recovered, 1U);
  EXPECT_NEAR(error_m(solution, truth), 50.0, 0.5);
}

TEST(NavigationFilter, CoastsWithoutFixesAndItsSigmaGrows) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  const NavSolution before = run(filter, truth, 20.0, 0.0);
  std::optional<NavSolution> after;
  for (int k = 0; k < 2000; ++k) after = filter.add(truth.next());
  EXPECT_EQ(after->mode, NavMode::Coasting);
  EXPECT_GT(after->position_sigma_ned_m.x(), 3.0 * before.position_sigma_ned_m.x());
}

TEST(NavigationFilter, SurvivesRatesThatAreNotThereAndOwnsUpToIt) {
  Circling truth, twin;
  NavigationFilter filter = begun(truth), undisturbed = begun(twin);
  run(filter, truth, 10.0, 0.0);
  run(undisturbed, twin, 10.0, 0.0);
  std::optional<NavSolution> solution, reference;
  for (int k = 0; k < 100; ++k) {
    ImuSample sample = truth.next();
    sample.gyro_valid = false;
    sample.dtheta_b.setZero();
    if (k % 2 == 0) sample.dv_b.x() = std::numeric_limits<double>::quiet_NaN();
    solution = filter.add(sample);
    reference = undisturbed.add(twin.next());
  }
  // The rate is constant: holding it over costs nothing, but the filter cannot know: 2 deg/s for 0.5 s is 1 deg.
  EXPECT_LT(error_m(*solution, truth), 0.01);
  EXPECT_NEAR(solution->attitude_sigma_rad.x(), 1.0 * units::kDeg, 0.1 * units::kDeg);
  EXPECT_LT(reference->attitude_sigma_rad.x(), 0.2 * units::kDeg);
  EXPECT_EQ(filter.counts().imu_not_valid, 100U);
}

TEST(NavigationFilter, BridgesMissingSamplesAndBeginsAnewAfterALongGap) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 10.0, 0.0);
  for (int k = 0; k < 50; ++k) truth.next();
  const auto bridged = filter.add(truth.next());
  EXPECT_LT(error_m(*bridged, truth), 0.05);
  EXPECT_EQ(filter.counts().imu_gaps, 1U);
  for (int k = 0; k < 400; ++k) truth.next();
  EXPECT_EQ(filter.add(truth.next())->mode, NavMode::Aligning);
  EXPECT_EQ(filter.counts().restarts, 1U);
}

TEST(NavigationFilter, SamplesOutOfOrderAreCountedAndChangeNothing) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  const ImuSample first = truth.next();
  filter.add(first);
  EXPECT_FALSE(filter.add(first).has_value());
  EXPECT_EQ(filter.counts().imu_out_of_order, 1U);
}

TEST(NavigationFilter, FixesWithoutASolutionOrANumberAreCountedAndChangeNothing) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  filter.add(truth.next());
  GnssFix none = truth.fix(), not_finite = truth.fix(), sure = truth.fix();
  none.fix_type = FixType::None;
  not_finite.height_m = std::numeric_limits<double>::quiet_NaN();
  sure.position_sigma_ned_m.setZero();
  for (const GnssFix& fix : {none, not_finite, sure}) filter.add(fix);
  EXPECT_EQ(filter.counts().fixes_not_used, 3U);
  EXPECT_TRUE(filter.take_results().empty());
}

TEST(NavigationFilter, AlignsAtRestAndThenNavigates) {
  NavigationParameters p;
  p.initial.alignment_s = 10.0;
  Circling still(0.0, 0.0);
  NavigationFilter filter(p, kGravity);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 1999; ++k) {
    solution = filter.add(still.next());
    if (is_fix_time(still)) filter.add(still.fix());
  }
  EXPECT_EQ(solution->mode, NavMode::Aligning);
  solution = filter.add(still.next());
  EXPECT_EQ(solution->mode, NavMode::Navigating);
  EXPECT_LT(nav::angle_between(solution->q_n_body, still.state().q_nb), 1e-9);
}

/// What the filter says after `seconds`; fixes come 0.1 s late.
NavSolution in_motion(NavigationFilter& filter, Circling& truth, const Vector3& arm_b_m, double seconds) {
  std::map<std::int64_t, GnssFix> on_its_way;
  std::optional<NavSolution> solution;
  for (int k = 0; k < static_cast<int>(seconds / kDt_s); ++k) {
    const ImuSample sample = truth.next();
    if (is_fix_time(truth)) on_its_way.emplace(truth.time_ns() + 100'000'000, truth.fix(arm_b_m));
    solution = filter.add(sample);
    while (!on_its_way.empty() && on_its_way.begin()->first <= truth.time_ns()) {
      filter.add(on_its_way.begin()->second);
      on_its_way.erase(on_its_way.begin());
    }
    if (solution->mode == NavMode::Navigating) break;
  }
  return *solution;
}

TEST(NavigationFilter, BeginsInMotionByTheChangeOfTheVelocity) {
  NavigationParameters p;
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  p.gyro.bias_sigma_deg_per_h.setConstant(20.0);
  Circling truth;
  NavigationFilter filter(p, kGravity);
  const NavSolution solution = in_motion(filter, truth, p.lever_arm_b_m, 30.0);
  ASSERT_EQ(solution.mode, NavMode::Navigating) << filter.motion_refusal();
  // The samples are perfect: what is left is the trapezoid between fixes and one rate a sample at the antenna.
  EXPECT_LT(nav::angle_between(solution.q_n_body, truth.state().q_nb), 0.1 * units::kDeg);
  EXPECT_LT((solution.v_n - truth.state().v_n).norm(), 0.02);
  // The fix is up to 0.3 s old, and 10 m/s turn by 0.1 rad/s: 0.01 m beside the mean of both velocities.
  EXPECT_LT(error_m(solution, truth), 0.05);
  EXPECT_GE(solution.attitude_sigma_rad.z(), 0.9 * units::kDeg) << "at least what the parameters say";
}

TEST(NavigationFilter, DoesNotBeginInAStraightCruise) {
  NavigationFilter filter({}, kGravity);
  Circling truth(10.0, 0.0);
  EXPECT_EQ(in_motion(filter, truth, Vector3::Zero(), 100.0).mode, NavMode::Aligning);
  EXPECT_NE(filter.motion_refusal().find("velocity changed by"), std::string::npos) << filter.motion_refusal();
}

TEST(NavigationFilter, DoesNotLevelItselfInASteadyTurn) {
  // 4 m/s at 0.1 rad/s press sideways with 0.4 m/s^2, as steadily as a tilt of 2 deg would.
  NavigationParameters p;
  p.initial.attitude = InitialAttitude::Levelled;
  p.initial.alignment_s = 2.0;
  Circling turning(4.0, 0.1);
  NavigationFilter filter(p, kGravity);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 2000; ++k) {
    solution = filter.add(turning.next());
    if (is_fix_time(turning)) filter.add(turning.fix());
  }
  EXPECT_EQ(solution->mode, NavMode::Aligning);
  EXPECT_NE(filter.alignment_refusal().find("the receiver says that it moves"), std::string::npos);
}

// A ship that rolls by 0.6 deg in 9 s: the mean force levels the mean attitude, not the one at the end.
TEST(NavigationFilter, LevelsASwayingVehicleNoSurerThanItSways) {
  constexpr double kSway_rad = 0.6 * units::kDeg, kOmega_rad_per_s = 2.0 * units::kPi / 9.0;
  const nav::Geodetic place{0.98, 0.22, 36.0};
  for (const double alignment_s : {20.0, 22.0, 25.0}) {
    NavigationParameters p;
    p.initial.attitude = InitialAttitude::Levelled;
    p.initial.alignment_s = alignment_s;
    NavigationFilter filter(p, kGravity);
    GnssFix fix;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = place.latitude_rad;
    fix.longitude_rad = place.longitude_rad;
    fix.height_m = place.height_m;
    fix.position_sigma_ned_m.setConstant(0.02);
    filter.add(fix);
    double roll_rad = 0.0;
    for (int k = 0; filter.filter() == nullptr && k < 10000; ++k) {
      const double t_s = (k + 1) * kDt_s;
      const double rolled_rad = kSway_rad * std::sin(kOmega_rad_per_s * t_s) - roll_rad;
      const Matrix3 C_bn = nav::matrix_from_rpy({roll_rad + 0.5 * rolled_rad, 0.0, 0.0}).transpose();
      roll_rad += rolled_rad;
      ImuSample sample;
      sample.dtheta_b = kDt_s * C_bn * nav::omega_ie_n(place.latitude_rad) + Vector3(rolled_rad, 0.0, 0.0);
      sample.dv_b = -kDt_s * C_bn * kGravity.g_n(place);
      sample.interval_ns = kDt_ns;
      sample.header.sim_time_ns = (k + 1) * kDt_ns;
      filter.add(sample);
    }
    ASSERT_NE(filter.filter(), nullptr) << filter.alignment_refusal();
    const Matrix3 C_nb = nav::matrix_from_quaternion(filter.filter()->state().q_nb);
    const double sigma_rad = std::sqrt(filter.filter()->covariance().matrix()(kAttitude, kAttitude));
    EXPECT_LT(std::abs(nav::rpy_from_matrix(C_nb).roll_rad - roll_rad), 2.0 * sigma_rad) << alignment_s;
    EXPECT_LT(sigma_rad, 3.0 * kSway_rad);
  }
}

TEST(NavigationFilter, RestHoldsTheVelocityThroughAnOutage) {
  // An unmodelled accelerometer error of 100 mGal: 30 s free would be 0.03 m/s and 0.45 m.
  const auto drift_m = [](bool use) {
    NavigationParameters p;
    p.zero_velocity.use = use;
    Circling still(0.0, 0.0);
    NavigationFilter filter = begun(still, p);
    std::optional<NavSolution> solution;
    for (int k = 0; k < 6000; ++k) {
      ImuSample sample = still.next();
      sample.dv_b.x() += 1e-3 * kDt_s;
      solution = filter.add(sample);
    }
    return error_m(*solution, still);
  };
  EXPECT_NEAR(drift_m(false), 0.45, 0.01);
  EXPECT_LT(drift_m(true), 0.15);
}

}  // namespace navigation_filter_test
}  // namespace inslab::navigation
