#include "inslab/models/imu/cross_axis_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "inslab/models/imu/imu_model.hpp"

namespace inslab::imu {
namespace cross_axis_drift_test {

TriadParameters drifting(double sigma, double correlation_time_s) {
  TriadParameters parameters;
  parameters.cross_axis_gm_sigma_rad.setConstant(sigma);
  parameters.cross_axis_gm_correlation_time_s.setConstant(correlation_time_s);
  return parameters;
}

/// The angle "x to y" as the error on y of an input of 1 on x.
double x_to_y(const CrossAxisDrift& drift) { return drift.next_error({1.0, 0.0, 0.0}).y(); }

TEST(CrossAxisDrift, HasTheSpreadAndCorrelationOfItsProcess) {
  // Variance sigma^2 and, one T apart, covariance sigma^2 / e. Of N = 20000 drawn T/10 apart the estimates' standard
  // deviations are sigma^2 sqrt(2 * 10 / N) = 0.032 sigma^2 for both, or less; four of them.
  CrossAxisDrift drift(drifting(2e-4, 1.0), 0.1, 5, "imu0/gyro");
  constexpr int kCount = 20000;
  std::vector<double> angles;
  for (std::uint64_t k = 0; k < kCount; ++k) {
    angles.push_back(x_to_y(drift) / 2e-4);
    drift.advance(k);
  }
  double variance = 0.0, covariance = 0.0;
  for (std::size_t k = 0; k + 10 < kCount; ++k) {
    variance += angles[k] * angles[k] / (kCount - 10);
    covariance += angles[k] * angles[k + 10] / (kCount - 10);
  }
  EXPECT_NEAR(variance, 1.0, 4 * 0.032);
  EXPECT_NEAR(covariance, std::exp(-1.0), 4 * 0.032);
}

TEST(CrossAxisDrift, SixAnglesDriftApartEachOnItsOwnAxes) {
  CrossAxisDrift one(drifting(1.0, 100.0), 0.1, 5, "imu0/gyro"), other(drifting(1.0, 100.0), 0.1, 5, "imu0/accel");
  const Vector3 x = one.next_error({1.0, 0.0, 0.0}), y = one.next_error({0.0, 1.0, 0.0});
  EXPECT_EQ(x.x(), 0.0);
  EXPECT_EQ(y.y(), 0.0);
  EXPECT_NE(x.y(), x.z());
  EXPECT_NE(x.y(), y.x());
  EXPECT_NE(x_to_y(one), x_to_y(other));
  TriadParameters z_to_y;
  z_to_y.cross_axis_gm_sigma_rad[5] = 1.0;
  z_to_y.cross_axis_gm_correlation_time_s[5] = 1.0;
  const CrossAxisDrift single(z_to_y, 0.1, 5, "imu0/gyro");
  EXPECT_EQ(single.next_error({1.0, 1.0, 0.0}), Vector3::Zero());
  EXPECT_NE(single.next_error({0.0, 0.0, 1.0}).y(), 0.0);
}

TEST(CrossAxisDrift, IsBookedAsCrossAxisAndLeavesTheOtherDrawsAlone) {
  ImuModel::Setup plain{42, 0, time::Rate(100.0), nav::Gravity(), {}, {}, {}};
  plain.errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  plain.errors.gyro.cross_axis_arcsec.setConstant(20.0);
  ImuModel::Setup drifts = plain;
  drifts.errors.gyro_cross_axis_gm_sigma_arcsec.setConstant(100.0);
  drifts.errors.gyro_cross_axis_gm_correlation_time_s.setConstant(10.0);
  ImuModel a(plain), b(drifts);
  for (int k = 0; k < 50; ++k) {
    TruthState truth;
    truth.header.sim_time_ns = k * 10000000;
    truth.interval_ns = k == 0 ? 0 : 10000000;
    truth.dtheta_v = {0.01, 0.0, 0.0};
    const auto without = a.measure(truth), with = b.measure(truth);
    if (k == 0) continue;
    EXPECT_EQ(without->truth.gyro_error.noise, with->truth.gyro_error.noise);
    const double more = with->truth.gyro_error.cross_axis.y() - without->truth.gyro_error.cross_axis.y();
    EXPECT_NE(more, 0.0);
    EXPECT_NEAR(with->sample.dtheta_b.y() - without->sample.dtheta_b.y(), more, 1e-17);
  }
}

}  // namespace cross_axis_drift_test
}  // namespace inslab::imu
