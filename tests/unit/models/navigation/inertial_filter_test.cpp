#include "inslab/models/navigation/inertial_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/initializer.hpp"
#include "inslab/models/navigation/measurements.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::navigation {
namespace inertial_filter_test {

constexpr double kDt_s = 0.0025;
constexpr std::int64_t kDt_ns = 2'500'000;
const nav::Gravity kGravity;

// Of the default layout, which has all blocks.
constexpr Eigen::Index kStates = 21, kGyroBias = 9, kAccelBias = 12, kGyroScale = 15, kAccelScale = 18;
using Vector21 = Eigen::Matrix<double, kStates, 1>;
using Matrix21 = Eigen::Matrix<double, kStates, kStates>;

UpdateResult take_in(InertialFilter& filter, const GnssFix& fix, const NavigationParameters& p) {
  return filter.update(measurements_of(fix, filter.situation(), p));
}

nav::NavState start_state() {
  return {{0.53, 2.0, 50.0}, {15.0, -9.0, 0.5}, nav::quaternion_from_rotation_vector({0.1, -0.2, 0.7})};
}

/// A lively but smooth motion: what the IMU's raw increments say.
ImuInterval raw_interval(int k) {
  const double t_s = (k + 0.5) * kDt_s;
  ImuInterval interval;
  interval.end_ns = (k + 1) * kDt_ns;
  interval.increments = {kDt_s * Vector3(0.10 + 0.02 * std::sin(t_s), -0.06, 0.2),
                         kDt_s * Vector3(1.0 + 0.3 * std::cos(t_s), -0.7, -9.5), kDt_s};
  return interval;
}

NavigationParameters parameters_at_every_sample() {
  NavigationParameters p;
  p.covariance_interval_s = 0.1;
  p.gyro.bias_correlation_time_s = p.accel.bias_correlation_time_s = Vector3::Zero();
  p.gyro.scale_factor_correlation_time_s = p.accel.scale_factor_correlation_time_s = Vector3::Zero();
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  return p;
}

/// A mechanization whose start and sensor errors are off by `x`: after `steps` intervals, at rest in its memory of the
/// interval before.
struct Mechanized {
  nav::NavState state;
  Vector3 omega_ib_b;
};

nav::NavState displaced_state(const nav::NavState& state, const Vector21& x) {
  nav::NavState off = state;
  const double s = std::sin(state.position.latitude_rad);
  off.position.latitude_rad += x[0] / (nav::wgs84::meridian_radius_from_sine_m(s) + state.position.height_m);
  off.position.longitude_rad += x[1] / ((nav::wgs84::transverse_radius_from_sine_m(s) + state.position.height_m) *
                                        std::cos(state.position.latitude_rad));
  off.position.height_m -= x[2];
  off.v_n += x.segment<3>(kVelocity);
  off.q_nb = nav::quaternion_from_rotation_vector(-x.segment<3>(kAttitude)) * state.q_nb;
  return off;
}

Mechanized mechanize(const nav::NavState& start, const Vector21& x, int steps) {
  // The estimate less the truth is x: with an estimate of x and a truth of 0 the increments are corrected by x.
  const auto corrected = [&](const nav::ImuIncrements& raw) {
    return nav::ImuIncrements{
        (raw.dtheta_b - raw.dt_s * x.segment<3>(kGyroBias)).cwiseQuotient(Vector3::Ones() + x.segment<3>(kGyroScale)),
        (raw.dv_b - raw.dt_s * x.segment<3>(kAccelBias)).cwiseQuotient(Vector3::Ones() + x.segment<3>(kAccelScale)),
        raw.dt_s};
  };
  nav::Strapdown strapdown(displaced_state(start, x), kGravity, {true}, corrected(raw_interval(-1).increments));
  nav::ImuIncrements last;
  for (int k = 0; k < steps; ++k) strapdown.advance(last = corrected(raw_interval(k).increments));
  return {strapdown.state(), last.dtheta_b / last.dt_s};
}

/// delta r, delta v, phi of two states that are close, in the metres of the first's place.
Eigen::Matrix<double, 9, 1> difference(const nav::NavState& high, const nav::NavState& low) {
  const double middle = 0.5 * (high.position.latitude_rad + low.position.latitude_rad);
  const double height_m = 0.5 * (high.position.height_m + low.position.height_m);
  const double s = std::sin(middle);
  Eigen::Matrix<double, 9, 1> d;
  d << (high.position.latitude_rad - low.position.latitude_rad) *
           (nav::wgs84::meridian_radius_from_sine_m(s) + height_m),
      (high.position.longitude_rad - low.position.longitude_rad) *
          (nav::wgs84::transverse_radius_from_sine_m(s) + height_m) * std::cos(middle),
      low.position.height_m - high.position.height_m, high.v_n - low.v_n,
      -nav::rotation_vector_from_quaternion(high.q_nb * low.q_nb.conjugate());
  return d;
}

/// Steps of the differences: what they do in 4 s is 1e-3 m at least, so that the rounding of a position, 1e-9 m, is
/// 1e-6 of it; the third order that they leave stays below 1e-7.
Vector21 steps_of_difference() {
  Vector21 h;
  h << 1000.0, 1000.0, 100.0, 1.0, 1.0, 1.0, 1e-4, 1e-4, 1e-4, Vector3::Constant(1e-4), Vector3::Constant(1e-3),
      Vector3::Constant(1e-4), Vector3::Constant(1e-4);
  return h;
}

/// The product of the filter's own transitions over `steps` intervals, each of one sample.
Matrix21 filter_transition(int steps) {
  NavigationParameters p = parameters_at_every_sample();
  InertialFilter filter(p, kGravity, start_state(), Vector21::Ones(), 0, raw_interval(-1).increments);
  Matrix21 product = Matrix21::Identity();
  for (int k = 0; k < steps; ++k) {
    filter.advance(raw_interval(k));
    const Transition t = filter.transition();
    filter.settle();
    Matrix21 Phi = Matrix21::Zero();
    Phi.topLeftCorner<9, 9>() = t.nav_by_nav;
    Phi.topRightCorner<9, 12>() = t.nav_by_chosen;
    Phi.bottomRightCorner<12, 12>() = t.decay.asDiagonal();
    product = (Phi * product).eval();
  }
  return product;
}

TEST(InertialFilter, ItsTransitionIsTheMechanizationsDerivativeInAll21States) {
  constexpr int kSteps = 1600;
  const Matrix21 found = filter_transition(kSteps) - Matrix21::Identity();
  const Vector21 h = steps_of_difference();
  for (Eigen::Index column = 0; column < kStates; ++column) {
    const Vector21 x = h[column] * Vector21::Unit(column);
    Eigen::Matrix<double, 9, 1> derivative =
        difference(mechanize(start_state(), x, kSteps).state, mechanize(start_state(), -x, kSteps).state) /
        (2.0 * h[column]);
    if (column < kNavStates) derivative[column] -= 1.0;
    // Relative to the whole effect on the same three errors; beside it the rounding of what is subtracted: 2e-9 m of
    // positions, 4e-15 m/s of velocities of 17 m/s, 2e-16 of attitudes, some of each.
    const Vector3 roundings(2e-9, 2e-14, 2e-15);
    for (Eigen::Index row = 0; row < 9; row += 3) {
      const double size = derivative.segment<3>(row).norm();
      const double rounding = roundings[row / 3] / h[column];
      EXPECT_LE((found.col(column).segment<3>(row) - derivative.segment<3>(row)).norm(), 1e-6 * size + rounding)
          << "errors " << row << " by state " << column << ", size " << size;
    }
  }
}

GnssFix fix_of(const nav::NavState& imu, const Vector3& omega_ib_b, const Vector3& arm_b_m) {
  const Matrix3 C_nb = nav::matrix_from_quaternion(imu.q_nb);
  const Vector3 arm_n = C_nb * arm_b_m;
  const nav::Geodetic antenna = nav::displaced(imu.position, arm_n);
  GnssFix fix;
  fix.fix_type = FixType::Fixed;
  fix.latitude_rad = antenna.latitude_rad;
  fix.longitude_rad = antenna.longitude_rad;
  fix.height_m = antenna.height_m;
  fix.v_n = imu.v_n + C_nb * omega_ib_b.cross(arm_b_m) - nav::omega_ie_n(imu.position.latitude_rad).cross(arm_n);
  fix.position_sigma_ned_m = Vector3::Constant(0.02);
  fix.velocity_sigma_ned_m_per_s = Vector3::Constant(0.03);
  return fix;
}

TEST(InertialFilter, FixesOfAnAntennaOnALeverArmLeaveATrueStateAsItIs) {
  const NavigationParameters p = parameters_at_every_sample();
  Vector21 sigmas = Vector21::Constant(1e-3);
  sigmas.head<9>() << 1, 1, 1, 1, 1, 1, 0.01, 0.01, 0.01;
  InertialFilter filter(p, kGravity, start_state(), sigmas, 0, raw_interval(-1).increments);
  filter.advance(raw_interval(0));
  const nav::NavState before = filter.state();
  const Vector3 omega = raw_interval(0).increments.dtheta_b / kDt_s;
  const UpdateResult result = take_in(filter, fix_of(before, omega, p.lever_arm_b_m), p);
  ASSERT_EQ(result.measurements.size(), 2U);
  EXPECT_TRUE(result.of("gnss_position")->accepted && result.of("gnss_velocity")->accepted);
  EXPECT_LT(nav::ned_from(before.position, filter.state().position).norm(), 1e-7);
  EXPECT_LT((filter.state().v_n - before.v_n).norm(), 1e-9);
  EXPECT_LT(nav::angle_between(filter.state().q_nb, before.q_nb), 1e-9);
}

/// With the covariance of a single known error, a perfect fix of the truth has to take all of that error away: only
/// when H's column is right does it.
TEST(InertialFilter, AFixTakesAwayEachErrorThatItSees) {
  NavigationParameters p = parameters_at_every_sample();
  p.innovation_test.limit = 1e9;
  // gyro bias and scale, seen through the velocity of the arm, in the last six.
  const double sizes[] = {1.0, 1.0, 1.0, 0.1, 0.1, 0.1, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 0, 0, 0, 1e-4, 1e-4, 1e-4};
  const Vector3 omega = raw_interval(0).increments.dtheta_b / kDt_s;
  for (Eigen::Index state : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17}) {
    const Vector21 x = sizes[state] * Vector21::Unit(state);
    const nav::NavState truth = start_state();
    InertialFilter filter(p, kGravity, state < 9 ? displaced_state(truth, x) : truth,
                          1e3 * sizes[state] * Vector21::Unit(state), 0, std::nullopt);
    // A short interval, so that what the error does in it is far below what is asked for.
    ImuInterval instant;
    instant.end_ns = 1;
    instant.increments = {1e-9 * omega, Vector3::Zero(), 1e-9};
    filter.advance(instant);
    Vector3 true_omega = omega;
    if (state >= kGyroScale)
      true_omega -= omega.cwiseProduct(-x.segment<3>(kGyroScale));
    else if (state >= kGyroBias)
      true_omega += x.segment<3>(kGyroBias);
    GnssFix fix = fix_of(truth, true_omega, p.lever_arm_b_m);
    fix.position_sigma_ned_m.setConstant(1e-4);
    fix.velocity_sigma_ned_m_per_s.setConstant(1e-5);
    take_in(filter, fix, p);
    if (state < 9) {
      EXPECT_LT(std::abs(difference(filter.state(), truth)[state]), 2e-3 * sizes[state]) << state;
    } else {
      const Estimates& e = filter.estimates();
      const double estimate = state >= kGyroScale ? e[StateBlock::GyroScale][state - kGyroScale]
                                                  : e[StateBlock::GyroBias][state - kGyroBias];
      EXPECT_NEAR(estimate, -sizes[state], 2e-2 * sizes[state]) << state;
    }
  }
}

/// At rest, level, without any other error: velocity random walk alone gives q t and q t^3/3.
TEST(InertialFilter, WhiteNoiseOfTheForceGrowsAsARandomWalkAndItsIntegral) {
  NavigationParameters p;
  p.accel.vrw_m_per_s_per_sqrt_h = Vector3::Constant(0.6);
  p.gyro.arw_deg_per_sqrt_h = Vector3::Zero();
  const nav::NavState rest{{0.5, 1.0, 0.0}, Vector3::Zero(), nav::Quaternion::Identity()};
  InertialFilter filter(p, kGravity, rest, Vector21::Zero(), 0, std::nullopt);
  ImuInterval still;
  still.increments = {kDt_s * nav::omega_ie_n(0.5), -kDt_s * kGravity.g_n(rest.position), kDt_s};
  constexpr int kSteps = 4000;
  // The sensors' own processes are off in this: their sigma is 0 in the parameters.
  for (auto* sigma : {&p.gyro.bias_sigma_deg_per_h, &p.accel.bias_sigma_mgal, &p.gyro.scale_factor_sigma_ppm,
                      &p.accel.scale_factor_sigma_ppm}) {
    sigma->setZero();
  }
  filter = InertialFilter(p, kGravity, rest, Vector21::Zero(), 0, std::nullopt);
  for (int k = 0; k < kSteps; ++k) {
    still.end_ns = (k + 1) * kDt_ns;
    filter.advance(still);
  }
  filter.settle();
  const double t_s = kSteps * kDt_s, q = 1e-4;  // (0.6/60)^2
  // Schuler's and the Earth's turn change q t^3/3 by (omega t)^2/5 < 4e-5 (Schuler) and 2 omega_e t = 1e-3 at most.
  EXPECT_NEAR(filter.covariance().matrix()(3, 3), q * t_s, 1e-3 * q * t_s);
  EXPECT_NEAR(filter.covariance().matrix()(0, 0), q * t_s * t_s * t_s / 3.0, 1e-3 * q * t_s * t_s * t_s / 3.0);
}

/// Angle random walk n: attitude n t, velocity g^2 n t^3/3, position g^2 n t^5/20.
TEST(InertialFilter, WhiteNoiseOfTheRateTiltsAndSoMoves) {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h = Vector3::Constant(0.3);
  p.accel.vrw_m_per_s_per_sqrt_h = Vector3::Zero();
  for (auto* sigma : {&p.gyro.bias_sigma_deg_per_h, &p.accel.bias_sigma_mgal, &p.gyro.scale_factor_sigma_ppm,
                      &p.accel.scale_factor_sigma_ppm}) {
    sigma->setZero();
  }
  const nav::NavState rest{{0.5, 1.0, 0.0}, Vector3::Zero(), nav::Quaternion::Identity()};
  InertialFilter filter(p, kGravity, rest, Vector21::Zero(), 0, std::nullopt);
  ImuInterval still;
  still.increments = {kDt_s * nav::omega_ie_n(0.5), -kDt_s * kGravity.g_n(rest.position), kDt_s};
  constexpr int kSteps = 4000;
  for (int k = 0; k < kSteps; ++k) {
    still.end_ns = (k + 1) * kDt_ns;
    filter.advance(still);
  }
  filter.settle();
  const double t_s = kSteps * kDt_s;
  const double n = std::pow(units::kDegPerSqrtH * 0.3, 2), g = kGravity.g_n(rest.position).z();
  const auto& P = filter.covariance().matrix();
  EXPECT_NEAR(P(6, 6), n * t_s, 1e-3 * n * t_s);
  EXPECT_NEAR(P(3, 3), g * g * n * std::pow(t_s, 3) / 3.0, 2e-3 * g * g * n * std::pow(t_s, 3) / 3.0);
  EXPECT_NEAR(P(0, 0), g * g * n * std::pow(t_s, 5) / 20.0, 2e-3 * g * g * n * std::pow(t_s, 5) / 20.0);
}

/// 0.15 deg/sqrt(h) and 0.5 deg/h for 60 s at 48.1 deg: 1.265 deg/h over 10.05 deg/h are 7.2 deg.
TEST(AlignmentSigmas, FollowFromTheImuTheTimeAtRestAndTheLatitude) {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h.setConstant(0.15);
  p.gyro.bias_sigma_deg_per_h.setConstant(0.5);
  p.accel.vrw_m_per_s_per_sqrt_h.setZero();
  p.accel.bias_sigma_mgal.setConstant(1000.0);
  const Vector3 sigmas = alignment_sigmas(p, 60.0, 48.1 * units::kDeg, 9.81);
  const double rate_deg_per_h = std::hypot(0.15 / std::sqrt(1.0 / 60.0), 0.5);
  EXPECT_NEAR(rate_deg_per_h, 1.265, 0.001);
  EXPECT_NEAR(sigmas.z(), rate_deg_per_h / (15.041067 * std::cos(48.1 * units::kDeg)), 1e-6);
  EXPECT_NEAR(sigmas.z() / units::kDeg, 7.2, 0.05);
  EXPECT_NEAR(sigmas.x(), 0.01 / 9.81, 1e-9);
}

/// The filter is sure of its velocity: what feels like rest is a gentle cruise.
TEST(InertialFilter, TakesNoZeroVelocityThatItsOwnVelocityContradicts) {
  NavigationParameters p = parameters_at_every_sample();
  for (const double speed_m_per_s : {0.01, 0.25}) {
    const nav::NavState slow{{0.5, 1.0, 0.0}, {speed_m_per_s, 0.0, 0.0}, nav::Quaternion::Identity()};
    Vector21 sigmas = Vector21::Zero();
    sigmas.segment<3>(kVelocity).setConstant(0.01);
    InertialFilter filter(p, kGravity, slow, sigmas, 0, std::nullopt);
    ImuInterval still;
    still.end_ns = kDt_ns;
    still.increments = {kDt_s * nav::omega_ie_n(0.5), -kDt_s * kGravity.g_n(slow.position), kDt_s};
    still.at_rest = true;
    filter.advance(still);
    // sigma 0.02 of the update: at 0.25 m/s the innovation is 11 standard deviations.
    const bool is_taken = filter.state().v_n.norm() < 0.99 * speed_m_per_s;
    EXPECT_EQ(is_taken, speed_m_per_s == 0.01) << filter.state().v_n.norm();
  }
}

}  // namespace inertial_filter_test
}  // namespace inslab::navigation
