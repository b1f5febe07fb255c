#include "inslab/models/imu/installation.hpp"

#include <gtest/gtest.h>

#include "inslab/foundation/time/gps_time.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

namespace inslab::imu {
namespace installation_test {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kPeriodS = 5e-3;

/// As AnalyticMotion::truth computes it: 35 s differ by 7e-15 s otherwise, and at 6 rad/s that shows.
double seconds(std::int64_t k) { return time::to_seconds(k * kPeriodNs); }

const nav::Gravity kGravity;

InstallationProfile profile(const Vector3& arm_v_m, const Vector3& rpy_deg = Vector3::Zero()) {
  InstallationProfile installation;
  installation.lever_arm_v_m = arm_v_m;
  installation.mounting_rpy_deg = rpy_deg;
  return installation;
}

TEST(Installation, AtTheReferencePointTheIncrementsAreTheVehiclesOwn) {
  const test::AnalyticMotion motion;
  const Installation installation(profile(Vector3::Zero()), kGravity);
  const TruthState before = motion.truth(10, kPeriodNs, kGravity);
  const TruthState truth = motion.truth(11, kPeriodNs, kGravity);
  const Installation::Instant end = installation.at(truth);
  const Increments out = installation.increments(truth, installation.at(before), end);
  EXPECT_EQ(out.dtheta, truth.dtheta_v);
  EXPECT_EQ(out.dv, truth.dv_v);
  EXPECT_EQ(end.site.position.latitude_rad, truth.latitude_rad);
  EXPECT_EQ(end.site.v_n, truth.v_n);
}

TEST(Installation, MountingTurnsTheIncrementsIntoTheImusAxes) {
  // Yawed by 90 deg, the IMU's x axis points to the vehicle's right; cos(90 deg) leaves 6e-17.
  const Installation installation(profile(Vector3::Zero(), {0.0, 0.0, 90.0}), kGravity);
  TruthState truth;
  truth.interval_ns = kPeriodNs;
  truth.dtheta_v = {1.0, 2.0, 3.0};
  truth.dv_v = {4.0, 5.0, 6.0};
  const Increments out = installation.increments(truth, installation.at(truth), installation.at(truth));
  EXPECT_TRUE(out.dtheta.isApprox(Vector3(2.0, -1.0, 3.0), 1e-15)) << out.dtheta.transpose();
  EXPECT_TRUE(out.dv.isApprox(Vector3(5.0, -4.0, 6.0), 1e-15)) << out.dv.transpose();
  const auto rpy = nav::rpy_from_quaternion(installation.q_nb(truth, installation.at(truth)));
  EXPECT_NEAR(rpy.yaw_rad, 1.57079632679489661923, 1e-15);
}

// The motion is written in ECEF and the specific force at the IMU's own place integrated by quadrature: what stage 1
// makes of the vehicle's truth must be that. Bounds of its approximations with |omega'| <= 3 rad/s^2,
// |omega'''| <= 8 rad/s^4, |omega| <= 2: centripetal 3 * 8 * 2 m * dt^4/360 = 1e-10 m/s^2; gravitation
// omega^2 dt^2/12 * 3e-6 * 2 m = 5e-11 m/s^2. The reference's own: rate differentiated to 1e-9 rad/s^2 times 2 m.
TEST(Installation, LeverArmGivesTheSpecificForceIntegratedAtTheImuItself) {
  const Vector3 arm_v(0.8, -0.5, 1.5);
  const test::AnalyticMotion motion;
  const Installation installation(profile(arm_v), kGravity);
  for (std::int64_t k = 1; k < 4000; k += 97) {
    const TruthState before = motion.truth(k - 1, kPeriodNs, kGravity);
    const TruthState truth = motion.truth(k, kPeriodNs, kGravity);
    const Increments out = installation.increments(truth, installation.at(before), installation.at(truth));
    const double t = seconds(k);
    const Vector3 expected = test::integral([&](double s) { return motion.f_v(s, arm_v, kGravity); }, t - kPeriodS, t);
    EXPECT_LT((out.dv - expected).norm() / kPeriodS, 3e-9) << k;
  }
}

TEST(Installation, TheTruncationOfTheCentripetalTermStaysBelowItsStatedBound) {
  // omega_z = a sin(w t) about a fixed axis at a metre: the exact centripetal integral is known, the attitude and
  // gravity play no part in it. Bound: |omega'| |omega'''| |l| dt^4/360 with both at their largest, a w and a w^3.
  constexpr double a = 2.0, w = 12.0, dt = 5e-3;
  const Installation installation(profile({1.0, 0.0, 0.0}), kGravity);
  const auto at = [&](double t) {
    TruthState truth;
    truth.latitude_rad = 0.5;
    truth.omega_iv_v = {0.0, 0.0, a * std::sin(w * t)};
    return truth;
  };
  double worst = 0.0;
  for (int k = 1; k <= 200; ++k) {
    const double t0 = (k - 1) * dt, t1 = k * dt;
    TruthState truth = at(t1);
    truth.interval_ns = kPeriodNs;
    truth.dtheta_v.z() = a / w * (std::cos(w * t0) - std::cos(w * t1));
    const auto start = installation.at(at(t0)), end = installation.at(truth);
    const double along_arm = installation.increments(truth, start, end).dv.x() -
                             0.5 * dt * (start.gravitation_difference_v + end.gravitation_difference_v).x();
    const double exact = -a * a * (0.5 * dt - (std::sin(2 * w * t1) - std::sin(2 * w * t0)) / (4.0 * w));
    worst = std::max(worst, std::abs(along_arm - exact) / dt);
  }
  EXPECT_LT(worst, a * w * a * w * w * w * std::pow(dt, 4) / 360.0 + 1e-12);  // 1e-12: rounding of dtheta / dt
}

TEST(Installation, GravitationOfAStaticVehicleFollowsTheArm) {
  // At rest gravity's magnitude at the IMU is the model's there, 1 m above the reference point; the specific force
  // differs by that and by nothing else. 1e-12 m/s^2 are a few roundings of g.
  const Installation installation(profile({0.0, 0.0, -1.0}), kGravity);
  TruthState truth;
  truth.latitude_rad = 0.7;
  truth.height_m = 100.0;
  truth.interval_ns = 1000000000;
  truth.omega_iv_v = nav::omega_ie_n(truth.latitude_rad);
  truth.dtheta_v = truth.omega_iv_v;
  truth.dv_v = -kGravity.g_n(nav::Geodetic{0.7, 0.0, 100.0});
  const auto instant = installation.at(truth);
  const Increments out = installation.increments(truth, instant, instant);
  const Vector3 expected = -kGravity.g_n(nav::Geodetic{0.7, 0.0, 101.0});
  EXPECT_LT((out.dv - expected).norm(), 1e-12) << (out.dv - expected).transpose();
}

TEST(Installation, AJumpOfTheRateGivesItsImpulseToTheIntervalThatEndsThere) {
  const Vector3 arm_v(1.0, 0.0, 0.0);
  const Installation installation(profile(arm_v), kGravity);
  TruthState before, truth;
  before.latitude_rad = truth.latitude_rad = 0.5;
  truth.interval_ns = kPeriodNs;
  truth.omega_iv_v = {0.0, 0.0, 0.4};  // after the jump; before it the vehicle did not turn
  truth.rate_jump = true;
  const Increments out = installation.increments(truth, installation.at(before), installation.at(truth));
  EXPECT_NEAR(out.dv.y(), 0.4, 1e-6 * kPeriodS * 4);  // omega x l; gravitation's 3e-6 m/s^2 over 5 ms stays
  EXPECT_NEAR(out.dv.x(), 0.0, 1e-6 * kPeriodS * 4);  // no turn inside the interval: no centripetal force
}

TEST(Installation, PoseOfTheImuIsTheRotatedArmAwayInAnyAttitude) {
  // Against ECEF positions differenced in the test: their cancellation leaves 1e-9 m * sqrt(3).
  const Vector3 arm_v(0.8, -0.5, 1.5);
  const Installation installation(profile(arm_v, {10.0, -20.0, 130.0}), kGravity);
  const test::AnalyticMotion motion(3.0);
  for (std::int64_t k = 0; k < 8000; k += 211) {
    const TruthState truth = motion.truth(k, kPeriodNs, kGravity);
    const auto instant = installation.at(truth);
    const double t = seconds(k);
    const Vector3 there_e = motion.path(t)[0] + motion.C_ev(t) * arm_v;
    EXPECT_LT((nav::ecef_from_geodetic(instant.site.position) - there_e).norm(), 5e-9);

    const Matrix3 C_en = nav::C_en(instant.site.position.latitude_rad, instant.site.position.longitude_rad);
    const Matrix3 C_vb = nav::matrix_from_quaternion(installation.q_vb());
    const Quaternion expected = nav::quaternion_from_matrix(C_en.transpose() * motion.C_ev(t) * C_vb);
    // Four products of rotations, each entry a sum of three terms good to 1.1e-16: sqrt(9) * 4 * 3 * 1.1e-16.
    EXPECT_LT(nav::angle_between(installation.q_nb(truth, instant), expected), 4e-15);
    EXPECT_GE(installation.q_nb(truth, instant).w(), 0.0);

    const Vector3 velocity_e = motion.path(t)[1] + motion.C_ev(t) * motion.omega_ev_v(t).cross(arm_v);
    EXPECT_LT((C_en * instant.site.v_n - velocity_e).norm(), 1e-12);
  }
}

}  // namespace installation_test
}  // namespace inslab::imu
