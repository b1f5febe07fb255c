#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/verify/vibration_block.hpp"

/// The block of `inslab verify vibration`, row by row as the command runs it, and that a wrong figure is seen.
namespace inslab::verify {
namespace verify_vibration_test {

constexpr double kDt = 5e-3;

TEST(VerifyVibration, EveryRowHolds) {
  for (const Table& table : vibration_tables(false)) EXPECT_TRUE(table.held()) << to_text(table);
}

TEST(VerifyVibration, TheResidualOfTheTwoSampleAlgorithmFallsWithTheFourthPowerOfTheInterval) {
  // x - sin x and sin^2 sin cancel to (x^5)/240 + ...: drift over dt^4 constant to x^2.
  const TwoAxisMotion coning{2.0, 1.0 * units::kDeg, 0.0};
  const double slow = two_sample_residual(coning, kDt), fast = two_sample_residual(coning, kDt / 2.0);
  EXPECT_NEAR(slow / fast, 16.0, 16.0 * 4e-3);
}

TEST(VerifyVibration, ADriftThatIsNotTheTextbooksIsSeen) {
  // The single-sample algorithm would lose (x - sin x)/2 of coning, fifty times as much here.
  const TwoAxisMotion coning{10.0, 1.0 * units::kDeg, 0.0};
  const double measured = measured_drift(coning, VibrationDomain::Motion, 2.0);
  const double x = 2.0 * 3.14159265358979323846 * 10.0 * kDt;
  const double single_sample = coning.theta_rad * coning.theta_rad / kDt * 0.5 * (x - std::sin(x));
  EXPECT_GT(single_sample, 40.0 * std::abs(measured));
}

TEST(VerifyVibration, ADensityThatIsNotTheTablesIsSeen) {
  // The table's density on x, were it measured on an IMU that shakes with a fifth more power.
  std::vector<LinearRandomPoint> table{{8.0, Vector3::Constant(0.1)}, {98.0, Vector3::Constant(0.1)}};
  const std::vector<BandResult> bands = verify_random(table, {1}, 1200.0);
  for (const BandResult& band : bands) EXPECT_GT(1.2 * band.ratio, band.upper) << band.low_hz;
}

}  // namespace verify_vibration_test
}  // namespace inslab::verify
