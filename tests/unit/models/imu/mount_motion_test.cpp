#include "inslab/models/imu/mount_motion.hpp"

#include <gtest/gtest.h>

#include "tests/unit/models/imu/analytic_motion.hpp"

namespace inslab::imu {
namespace mount_motion_test {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kPeriodS = 5e-3;
const nav::Gravity kGravity;
const Vibration::Setup kSetup{kPeriodS, 42, "imu0"};

VibrationProfile moving() {
  VibrationProfile profile;
  profile.domain = VibrationDomain::Motion;
  profile.linear.push_back({Vector3(3.0, -2.0, 9.0), 17.0, Vector3(0.0, 90.0, 40.0)});
  profile.linear.push_back({Vector3(4.0, 5.0, 6.0), 130.0, Vector3(70.0, 0.0, 200.0)});
  profile.angular.push_back({Vector3(60.0, 40.0, -50.0), 23.0, Vector3(10.0, 100.0, 30.0)});
  return profile;
}

Installation installation() {
  InstallationProfile profile;
  profile.lever_arm_v_m = {0.8, -0.5, 1.5};
  profile.mounting_rpy_deg = {10.0, -20.0, 130.0};
  return Installation(profile, kGravity);
}

/// Five-point derivative of a function of time: error h^4/30 of the fifth derivative.
template <class F>
auto derivative(const F& f, double h) {
  return
      [f, h](double t) { return ((8.0 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12.0 * h)).eval(); };
}

Matrix3 C_mb(const MountState& state) {
  return nav::matrix_from_quaternion(nav::quaternion_from_rotation_vector(state.turn_rad));
}

TEST(VibrationMount, VelocityAndTurnRateAreTheDerivativesThroughFadesToo) {
  Vibration vibration(VibrationProfile(), kSetup);
  vibration.swap(moving(), 0, 0.2);
  VibrationProfile other = moving();
  other.linear[0].frequency_hz = 11.0;
  vibration.swap(other, 100000000, 0.3);
  const auto displacement = [&](double t) { return vibration.mount(0, t).displacement_m; };
  const auto turn = [&](double t) { return vibration.mount(0, t).turn_rad; };
  for (double t = 0.01; t < 0.5; t += 0.0137) {
    const MountState state = vibration.mount(0, t);
    // h = 0.1 ms: h^4/30 (2 pi 130)^5 of 9e-6 m is 1e-8 m/s.
    EXPECT_LT((derivative(displacement, 1e-4)(t) - state.velocity_m_per_s).norm(), 2e-8) << t;
    EXPECT_LT((derivative(turn, 1e-4)(t) - state.turn_rate_rad_per_s).norm(), 2e-8) << t;
  }
}

TEST(VibrationMount, TheSinusoidIsTheSecondDerivativeOfTheDisplacement) {
  const Vibration vibration(moving(), kSetup);
  const auto velocity = [&](double t) { return vibration.mount(0, t).velocity_m_per_s; };
  const double pi = 3.14159265358979323846, t = 0.123;
  const double z =
      9.0 * std::sin(2 * pi * 17.0 * t + 40.0 * pi / 180) + 6.0 * std::sin(2 * pi * 130.0 * t + 200.0 * pi / 180);
  EXPECT_NEAR(derivative(velocity, 1e-5)(t).z(), z, 1e-8);  // rounding of 0.08 m/s over 1e-5 s
}

TEST(MountMotion, IncrementsAreTheIntegralsOfRateAndForceFeltOnTheMovingMount) {
  // The reference adds up accelerations, Coriolis and centripetal terms at the moving point, where the product
  // integrates by parts; the rate comes from differentiated attitudes. Left out: gravitation over the displacement,
  // 3.1e-6/s^2 of 2e-3 m; the quadratics' deviation from omega over an arm, 3e-9 m/s^2 as without vibration.
  const Installation place = installation();
  const Vibration vibration(moving(), kSetup);
  const test::AnalyticMotion motion;
  const Matrix3 C_vm = place.C_bv().transpose();
  const auto mount = [&](double t) { return vibration.mount(0, t); };
  const auto attitude = [&](double t) { return C_mb(mount(t)); };
  const auto velocity = [&](double t) { return mount(t).velocity_m_per_s; };
  const auto omega_ib_b = [&](double t) {
    const Matrix3 C = attitude(t);
    const Matrix3 cross = C.transpose() * derivative(attitude, 1e-4)(t);
    return Vector3(C.transpose() * (C_vm.transpose() * motion.omega_iv_v(t)) +
                   Vector3(cross(2, 1), cross(0, 2), cross(1, 0)));
  };
  const auto f_b = [&](double t) {
    const MountState state = mount(t);
    const Vector3 omega_m = C_vm.transpose() * motion.omega_iv_v(t);
    const Vector3 at_point =
        C_vm.transpose() * motion.f_v(t, place.lever_arm_v_m() + C_vm * state.displacement_m, kGravity);
    return Vector3(C_mb(state).transpose() *
                   (at_point + 2.0 * omega_m.cross(state.velocity_m_per_s) + derivative(velocity, 2e-5)(t)));
  };
  for (std::int64_t k = 1; k < 2000; k += 197) {
    const TruthState before = motion.truth(k - 1, kPeriodNs, kGravity);
    const TruthState truth = motion.truth(k, kPeriodNs, kGravity);
    const Increments out = mounted_increments(place, before, truth, place.at(before), place.at(truth), vibration);
    const double t = static_cast<double>(k) * kPeriodS;
    // The reference's own derivatives: (1e-4 s)^4/30 (2 pi 23 Hz)^5 of 7e-3 rad, (2e-5 s)^4/30 (2 pi 130 Hz)^5 of 0.01
    // m/s.
    EXPECT_LT((out.dtheta - test::integral(omega_ib_b, t - kPeriodS, t, 8)).norm() / kPeriodS, 2e-8) << k;
    EXPECT_LT((out.dv - test::integral(f_b, t - kPeriodS, t, 8)).norm() / kPeriodS, 3e-8) << k;
  }
}

TEST(MountMotion, PoseIsThatOfTheMovedPoint) {
  const Installation place = installation();
  const Vibration vibration(moving(), kSetup);
  const test::AnalyticMotion motion(3.0);
  const Matrix3 C_vm = place.C_bv().transpose();
  const auto position_e = [&](double t) {
    const Vector3 arm_v = place.lever_arm_v_m() + C_vm * vibration.mount(0, t).displacement_m;
    return Vector3(motion.C_ev(t) * arm_v);  // from the vehicle's point, so that little cancels
  };
  for (std::int64_t k = 0; k < 4000; k += 211) {
    const TruthState truth = motion.truth(k, kPeriodNs, kGravity);
    const MountedPose pose = mounted_pose(place, truth, vibration);
    const double t = static_cast<double>(k) * kPeriodS;
    const auto [r_e, v_e, a_e] = motion.path(t);
    EXPECT_LT((nav::ecef_from_geodetic(pose.site.position) - r_e - position_e(t)).norm(), 5e-9);
    const Matrix3 C_en = nav::C_en(pose.site.position.latitude_rad, pose.site.position.longitude_rad);
    EXPECT_LT((C_en * pose.site.v_n - v_e - derivative(position_e, 1e-4)(t)).norm(), 5e-8);
    const Quaternion expected =
        nav::quaternion_from_matrix(C_en.transpose() * motion.C_ev(t) * C_vm * C_mb(vibration.mount(0, t)));
    // Seven products of rotations, each entry a sum of three terms good to 1.1e-16: sqrt(9) * 7 * 3 * 1.1e-16.
    EXPECT_LT(nav::angle_between(pose.q_nb, expected), 7e-15);
  }
}

}  // namespace mount_motion_test
}  // namespace inslab::imu
