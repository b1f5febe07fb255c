#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/inertial_filter.hpp"
#include "inslab/models/navigation/measurements.hpp"
#include "inslab/nav/attitude.hpp"

/// The filter at rest, one thing uncertain at a time, against what a Kalman filter of two states or least squares give
/// in closed form.
namespace inslab::navigation {
namespace closed_forms_test {

constexpr double kDt_s = 0.01;
constexpr std::int64_t kDt_ns = 10'000'000;
constexpr double kLatitude_rad = 0.5;
const nav::Gravity kGravity;

// Of the default layout, which has all blocks.
constexpr Eigen::Index kStates = 21, kGyroBias = 9, kAccelBias = 12, kAccelScale = 18;
using Vector21 = Eigen::Matrix<double, kStates, 1>;

/// Sensors without any error or noise, and an antenna at the IMU.
NavigationParameters perfect() {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h.setZero();
  p.accel.vrw_m_per_s_per_sqrt_h.setZero();
  for (auto* each : {&p.gyro.bias_sigma_deg_per_h, &p.accel.bias_sigma_mgal, &p.gyro.scale_factor_sigma_ppm,
                     &p.accel.scale_factor_sigma_ppm, &p.gyro.bias_correlation_time_s, &p.accel.bias_correlation_time_s,
                     &p.gyro.scale_factor_correlation_time_s, &p.accel.scale_factor_correlation_time_s}) {
    each->setZero();
  }
  return p;
}

/// An IMU at rest, level, looking north, and the filter that believes `parameters`.
class AtRest {
 public:
  AtRest(const NavigationParameters& parameters, const Vector21& sigmas)
      : parameters_(parameters), filter_(parameters, kGravity, state(), sigmas, 0, std::nullopt) {}

  /// Goes on by whole samples; `at_rest`: the last one ends a window of rest.
  void advance(double seconds, bool at_rest = false, const Vector3& accel_bias_b = Vector3::Zero()) {
    const auto samples = static_cast<int>(std::lround(seconds / kDt_s));
    for (int k = 1; k <= samples; ++k) {
      ImuInterval still;
      still.end_ns = filter_.time_ns() + kDt_ns;
      still.increments = {kDt_s * nav::omega_ie_n(kLatitude_rad),
                          kDt_s * (accel_bias_b - kGravity.g_n(state().position)), kDt_s};
      still.at_rest = at_rest && k == samples;
      filter_.advance(still);
    }
  }
  /// A fix of the truth; a velocity sigma of 0 means that it has no velocity.
  void fix(double position_sigma_m, double velocity_sigma_m_per_s) {
    GnssFix fix;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = state().position.latitude_rad;
    fix.longitude_rad = state().position.longitude_rad;
    fix.height_m = state().position.height_m;
    fix.position_sigma_ned_m.setConstant(position_sigma_m);
    fix.velocity_sigma_ned_m_per_s.setConstant(velocity_sigma_m_per_s);
    filter_.update(measurements_of(fix, filter_.situation(), parameters_));
  }
  const StateMatrix& settled() {
    filter_.settle();
    return filter_.covariance().matrix();
  }
  const InertialFilter& filter() const { return filter_; }

 private:
  static nav::NavState state() { return {{kLatitude_rad, 1.0, 0.0}, Vector3::Zero(), nav::Quaternion::Identity()}; }
  NavigationParameters parameters_;
  InertialFilter filter_;
};

Vector21 sigmas(double position_m, double velocity_m_per_s) {
  Vector21 s = Vector21::Zero();
  s.segment<3>(kPosition).setConstant(position_m);
  s.segment<3>(kVelocity).setConstant(velocity_m_per_s);
  return s;
}

void expect_relative(double found, double expected, double tolerance) {
  EXPECT_NEAR(found, expected, tolerance * expected);
}

// A velocity that walks by q = N^2 T between updates of variance R: the variance after an update obeys
// 1/P = 1/(P + q) + 1/R, so P = (sqrt(q^2 + 4 q R) - q)/2. The Earth's turn in 1 s moves 7e-5 of it between axes that
// have the same.
TEST(ClosedForms, ZeroVelocityUpdatesHoldTheVelocityAtTheSteadyStateOfARandomWalk) {
  NavigationParameters p = perfect();
  p.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.6);
  p.zero_velocity.sigma_m_per_s = 0.02;
  AtRest imu(p, sigmas(1.0, 1.0));
  for (int second = 0; second < 60; ++second) imu.advance(1.0, true);
  const double q = 1e-4, r = 0.02 * 0.02;  // (0.6/60)^2 times 1 s
  const double expected = 0.5 * (std::sqrt(q * q + 4.0 * q * r) - q);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    expect_relative(imu.settled()(kVelocity + axis, kVelocity + axis), expected, 1e-4);
  }
}

// Positions of variance R every T of a point whose velocity walks with density q: the steady gains alpha = P_rr/R and
// beta = T P_rv/R after an update obey q T^3/R = beta^2/(1 - alpha), alpha = sqrt(2 beta + beta^2/12) - beta/2
// (Bar-Shalom, Li, Kirubarajan, Estimation with Applications, section 6.5, discretised continuous white noise).
// Schuler's feedback is (t/806 s)^2 of it, 3e-5 over the filter's memory (R T/q)^(1/4) = 4.7 s.
TEST(ClosedForms, PositionsAloneGiveTheGainsOfASteadyAlphaBetaFilter) {
  NavigationParameters p = perfect();
  p.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.6);
  const double q = 1e-4, T_s = 0.2, R = 0.5 * 0.5;
  AtRest imu(p, sigmas(1.0, 1.0));
  for (int k = 0; k < 400; ++k) {
    imu.advance(T_s);
    imu.fix(0.5, 0.0);
  }
  const auto alpha_of = [](double beta) { return std::sqrt(2.0 * beta + beta * beta / 12.0) - 0.5 * beta; };
  double low = 0.0, high = 1.0;  // of beta: beta^2/(1 - alpha) grows with it
  for (int i = 0; i < 60; ++i) {
    const double beta = 0.5 * (low + high);
    (beta * beta / (1.0 - alpha_of(beta)) < q * T_s * T_s * T_s / R ? low : high) = beta;
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    expect_relative(imu.settled()(kPosition + axis, kPosition + axis), alpha_of(low) * R, 2e-4);
    expect_relative(imu.settled()(kPosition + axis, kVelocity + axis), low * R / T_s, 2e-4);
  }
}

// Least squares: velocities of variance R at t_k show a constant bias b as b t_k; its information is
// 1/sigma^2 + sum t_k^2/R, and its estimate the true bias by the second term's share. Over 20 s Schuler's feedback
// takes (20/806)^2/6 = 1e-4 of b t.
TEST(ClosedForms, AConstantAccelerometerBiasIsFoundAsByLeastSquares) {
  NavigationParameters p = perfect();
  p.accel.bias_sigma_mgal.setConstant(100.0);
  Vector21 start = Vector21::Zero();
  start.segment<3>(kAccelBias).setConstant(1e-3);
  AtRest imu(p, start);
  const Vector3 bias(2e-3, -1e-3, 1.5e-3);
  double information = 0.0;
  for (int k = 1; k <= 100; ++k) {
    imu.advance(0.2, false, bias);
    imu.fix(1e4, 0.05);
    information += 0.04 * k * k / (0.05 * 0.05);
  }
  const double prior = 1e6;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    expect_relative(imu.settled()(kAccelBias + axis, kAccelBias + axis), 1.0 / (prior + information), 5e-4);
    EXPECT_NEAR(imu.filter().estimates()[StateBlock::AccelBias][axis], bias[axis] * information / (prior + information),
                5e-4 * 2e-3);
  }
}

// At rest only b - g phi shows, so the bias keeps the variance sigma_b^2 s^2/(sigma_b^2 + s^2), s = g sigma_phi,
// however long it is watched: what is left of the combination itself is 3e-4 of it, and the Earth's turn, which in 10 s
// tells the two apart by g phi omega t^2/2 = 2e-5 m/s, 3e-4 more.
TEST(ClosedForms, ABiasAndATiltAreNotToldApartAtRest) {
  NavigationParameters p = perfect();
  p.accel.bias_sigma_mgal.setConstant(1000.0);
  Vector21 start = Vector21::Zero();
  start.segment<2>(kAttitude).setConstant(1e-3);
  start.segment<2>(kAccelBias).setConstant(1e-2);
  AtRest imu(p, start);
  for (int k = 0; k < 100; ++k) {
    imu.advance(0.1);
    imu.fix(1e4, 0.01);
  }
  const double s = 1e-3 * kGravity.g_n({kLatitude_rad, 1.0, 0.0}).z();
  const double expected = 1e-4 * s * s / (1e-4 + s * s);
  expect_relative(imu.settled()(kAccelBias, kAccelBias), expected, 1e-3);
  expect_relative(imu.settled()(kAccelBias + 1, kAccelBias + 1), expected, 1e-3);
}

// sigma^2 (1 - exp(-2 t/T)) from nothing, and sigma^2 for ever from sigma^2; 3000 steps of rounding.
TEST(ClosedForms, AGaussMarkovErrorGrowsToItsSteadyState) {
  NavigationParameters p = perfect();
  p.gyro.bias_sigma_deg_per_h.setConstant(2.0);
  p.gyro.bias_correlation_time_s.setConstant(50.0);
  p.accel.scale_factor_sigma_ppm.setConstant(300.0);
  p.accel.scale_factor_correlation_time_s.setConstant(20.0);
  Vector21 start = Vector21::Zero();
  start.segment<3>(kAccelScale).setConstant(300e-6);
  AtRest imu(p, start);
  imu.advance(30.0);
  const double sigma = 2.0 * units::kDegPerH;
  expect_relative(imu.settled()(kGyroBias, kGyroBias), sigma * sigma * (1.0 - std::exp(-60.0 / 50.0)), 1e-11);
  expect_relative(imu.settled()(kAccelScale, kAccelScale), 9e-8, 1e-11);
}

/// A lively motion with fixes every second, each as good as RTK; the sigmas of all states before each fix.
std::vector<Vector21> sigmas_with_steps_of(double covariance_interval_s) {
  NavigationParameters p;
  p.covariance_interval_s = covariance_interval_s;
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  InertialFilter filter(p, kGravity,
                        {{0.53, 2.0, 50.0}, {15.0, -9.0, 0.5}, nav::quaternion_from_rotation_vector({0.1, -0.2, 0.7})},
                        Vector21(sigmas(1.0, 0.1)) + Vector21::Constant(1e-3), 0, std::nullopt);
  std::vector<Vector21> found;
  for (int k = 0; k < 12000; ++k) {
    const double t_s = (k + 0.5) * 0.0025;
    ImuInterval interval;
    interval.end_ns = (k + 1) * 2'500'000LL;
    interval.increments = {0.0025 * Vector3(0.1 * std::cos(t_s), -0.06 * std::sin(0.7 * t_s), 0.2),
                           0.0025 * Vector3(1.0 + 0.3 * std::cos(t_s), -0.7, -9.5), 0.0025};
    filter.advance(interval);
    if ((k + 1) % 400 != 0) continue;
    filter.settle();
    found.push_back(filter.covariance().matrix().diagonal().cwiseSqrt());
    const nav::NavState now = filter.state();
    GnssFix fix;
    const nav::Geodetic antenna = nav::displaced(now.position, nav::matrix_from_quaternion(now.q_nb) * p.lever_arm_b_m);
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = antenna.latitude_rad;
    fix.longitude_rad = antenna.longitude_rad;
    fix.height_m = antenna.height_m;
    fix.position_sigma_ned_m.setConstant(0.02);
    filter.update(measurements_of(fix, filter.situation(), p));
  }
  return found;
}

// What a step of d = 0.02 s costs over the T = 1 s between fixes. Noise that comes in half before and half after each
// step is the trapezoidal rule of its integrals: q T^3/3 of position is d^2/(2 T^2) too large, and g^2 n T^5/20, of the
// attitude's noise, (20/12) d^2/T^2 = 7e-4; of sigma half of that. The third order of the transition, (omega d)^2/12,
// is 2e-6.
TEST(CovarianceSteps, ChangeNoSigmaByMoreThanTheirTrapezoidsDo) {
  const std::vector<Vector21> coarse = sigmas_with_steps_of(0.02), fine = sigmas_with_steps_of(0.0);
  ASSERT_EQ(coarse.size(), 30U);
  double largest = 0.0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    largest = std::max(largest, (coarse[i].cwiseQuotient(fine[i]).array() - 1.0).abs().maxCoeff());
  }
  EXPECT_LT(largest, 3.5e-4);
  EXPECT_GT(largest, 0.0);
}

}  // namespace closed_forms_test
}  // namespace inslab::navigation
