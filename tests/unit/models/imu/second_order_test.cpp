#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/imu/rectification.hpp"
#include "inslab/models/imu/second_order_drift.hpp"

/// Squares and products of what is felt, within the interval too.
namespace inslab::imu {
namespace second_order_test {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kPeriodS = 5e-3;

ImuModel::Setup setup() { return {42, 0, time::Rate(200.0), nav::Gravity(), {}, {}, {}}; }

TruthState still(std::int64_t k) {
  TruthState truth;
  truth.header.sim_time_ns = k * kPeriodNs;
  truth.interval_ns = k == 0 ? 0 : kPeriodNs;
  return truth;
}

TEST(SecondOrderDrift, EachRowIsAGyroAndEachColumnASquareOrAProduct) {
  Vector9 rows;
  rows << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0;
  const SecondOrderDrift squares(rows, Vector9::Zero(), Vector9::Zero());
  const SecondOrderDrift products(Vector9::Zero(), rows, Vector9::Zero());
  const SecondOrderDrift rates(Vector9::Zero(), Vector9::Zero(), rows);
  const double g = 9.80665, deg = std::acos(-1.0) / 180.0, deg_per_h = deg / 3600.0;
  // A second of 2 g along y: the squares are (0, 4, 0) g^2.
  EXPECT_TRUE(squares.of_force({0.0, 2.0 * g, 0.0}, Matrix3::Zero(), 1.0)
                  .isApprox(Vector3(8.0, 20.0, 32.0) * deg_per_h, 1e-14));
  // 2 g along y, 3 g along z: y z is 6 g^2, the others 0.
  EXPECT_TRUE(products.of_force({0.0, 2.0 * g, 3.0 * g}, Matrix3::Zero(), 1.0)
                  .isApprox(Vector3(6.0, 24.0, 42.0) * deg_per_h, 1e-14));
  // 2 deg/s about z, 3 deg/s about x: z x is 6 (deg/s)^2.
  EXPECT_TRUE(rates.of_rate(Vector3(3.0, 0.0, 2.0) * deg, 1.0).isApprox(Vector3(12.0, 30.0, 48.0) * deg_per_h, 1e-14));
}

/// Mean of x_i x_j less the product of the means over the interval that ends at k, by the sum of 200000 middles, whose
/// error is (2 pi f h)^2 / 24 of it: below 1e-6 at 4 kHz.
Matrix3 moments_by_summing(const VibrationProfile& profile, std::int64_t k) {
  constexpr int kSteps = 200000;
  Matrix3 squares = Matrix3::Zero();
  Vector3 mean = Vector3::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const double t = (static_cast<double>(k - 1) + (i + 0.5) / kSteps) * kPeriodS;
    Vector3 f = Vector3::Zero();
    for (const LinearSinusoid& s : profile.linear) {
      for (int axis = 0; axis < 3; ++axis) {
        f[axis] += s.amplitude_m_per_s2[axis] *
                   std::sin(2.0 * units::kPi * s.frequency_hz * t + s.phase_deg[axis] * units::kDeg);
      }
    }
    mean += f / kSteps;
    squares += f * f.transpose() / kSteps;
  }
  return squares - mean * mean.transpose();
}

VibrationProfile engine() {
  VibrationProfile profile;
  profile.linear.push_back({Vector3(3.0, 2.0, 1.0), 37.0, Vector3(10.0, 80.0, 0.0)});
  profile.linear.push_back({Vector3(30.0, 20.0, 40.0), 510.0, Vector3(0.0, 45.0, 200.0)});
  profile.linear.push_back({Vector3(5.0, 9.0, 2.0), 523.0, Vector3(20.0, 0.0, 60.0)});
  return profile;
}

TEST(VibrationMoments, AreThoseOfTheSinusoidsSummedUp) {
  Vibration vibration(engine(), {kPeriodS, 42, "imu0"});
  for (const std::int64_t k : {1, 2, 77}) {
    const Matrix3 expected = moments_by_summing(engine(), k);
    EXPECT_LT((vibration.moments((k - 1) * kPeriodNs, k * kPeriodNs) - expected).norm(), 1e-6 * expected.norm()) << k;
  }
}

TEST(VibrationMoments, OfRandomVibrationAreWhatTheMeansLeaveOfIt) {
  // Flat from 1 kHz to 4 kHz: 3000 Hz of 0.5, less what sinc^2 leaves, 1 / (2 pi^2 dt^2) (1/1000 - 1/4000) of S.
  VibrationProfile profile;
  profile.linear_random = {{1000.0, Vector3(0.5, 0.0, 2.0)}, {4000.0, Vector3(0.5, 0.0, 2.0)}};
  Vibration vibration(profile, {kPeriodS, 42, "imu0"});
  const double within = 3000.0 - (1.0 / 1000.0 - 1.0 / 4000.0) / (2.0 * units::kPi * units::kPi * kPeriodS * kPeriodS);
  const Matrix3 moments = vibration.moments(0, kPeriodNs);
  EXPECT_NEAR(moments(0, 0), 0.5 * within, 1e-4 * within);
  EXPECT_EQ(moments(1, 1), 0.0);
  EXPECT_NEAR(moments(2, 2), 2.0 * within, 4e-4 * within);
}

TEST(Rectification, OfAStrongVibrationIsHalfTheSquareOfItsAmplitude) {
  // 10 g at 2 kHz, ten whole periods an interval: 50 g^2 of 20 mGal/g^2 are 1000 mGal.
  ImuModel::Setup s = setup();
  s.errors.accel_rectification_mgal_per_g2 = {20.0, 0.0, 20.0};
  s.vibration.linear.push_back({Vector3(98.0665, 98.0665, 0.0), 2000.0, Vector3::Zero()});
  ImuModel model(s);
  model.measure(still(0));
  const auto output = model.measure(still(1));
  EXPECT_NEAR(output->truth.accel_error.bias.x(), 1000e-5 * kPeriodS, 1e-14);
  EXPECT_EQ(output->truth.accel_error.bias.y(), 0.0);
  EXPECT_EQ(output->truth.accel_error.bias.z(), 0.0);
  EXPECT_NEAR(output->sample.dv_b.x(), 1000e-5 * kPeriodS, 1e-13);
}

TEST(Rectification, ASteadyForceIsNotRectified) {
  ImuModel::Setup s = setup();
  s.errors.accel_rectification_mgal_per_g2.setConstant(20.0);
  ImuModel model(s);
  TruthState first = still(0), second = still(1);
  first.f_v = second.f_v = {0.0, 0.0, -9.8};
  second.dv_v = {0.0, 0.0, -9.8 * kPeriodS};
  model.measure(first);
  EXPECT_EQ(model.measure(second)->sample.dv_b, second.dv_v);
}

TEST(SecondOrderDrift, OfAModelCountsTheVibrationWithinTheInterval) {
  // Gyro y by the product x y of 10 g and 4 g in phase at 2 kHz: 20 g^2; and by the square of 1 g along z.
  ImuModel::Setup s = setup();
  s.errors.gyro_anisoelasticity_deg_per_h_per_g2[5] = 3.0;
  s.errors.gyro_g2_sensitivity_deg_per_h_per_g2[5] = 7.0;
  s.vibration.linear.push_back({Vector3(98.0665, 39.2266, 0.0), 2000.0, Vector3::Zero()});
  ImuModel model(s);
  TruthState first = still(0), second = still(1);
  second.dv_v = {0.0, 0.0, -9.80665 * kPeriodS};
  model.measure(first);
  const auto output = model.measure(second);
  EXPECT_NEAR(output->truth.gyro_error.g_sensitivity.y(), 67.0 * units::kDegPerH * kPeriodS, 1e-15);
  EXPECT_EQ(output->sample.dtheta_b.y(), output->truth.gyro_error.g_sensitivity.y());
}

}  // namespace second_order_test
}  // namespace inslab::imu
