#include "inslab/models/imu/triad_parameters.hpp"

#include <gtest/gtest.h>

#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {
namespace triad_parameters_test {

TEST(TriadParameters, UnitsOfGyroDataSheetsBecomeSi) {
  GyroErrors gyro;
  gyro.bias_constant_deg_per_h.setConstant(3600.0);
  gyro.bias_random_walk_deg_per_h_per_sqrt_h.setConstant(3600.0 * 60.0);
  gyro.bias_instability_deg_per_h.setConstant(3600.0);
  gyro.bias_temperature_deg_per_h_per_deg_c.setConstant(3600.0);
  gyro.arw_deg_per_sqrt_h.setConstant(60.0);
  gyro.scale_factor_ppm.setConstant(1e5);
  gyro.scale_factor_asymmetry_ppm.setConstant(2e5);
  gyro.cross_axis_arcsec.setConstant(3600.0);
  gyro.full_scale_deg_per_s.setConstant(400.0);
  gyro.quantization_arcsec.setConstant(3600.0);
  const TriadParameters si = in_si(gyro);
  EXPECT_DOUBLE_EQ(si.bias_constant.x(), units::kDeg);
  EXPECT_DOUBLE_EQ(si.bias_random_walk.x(), units::kDeg);
  EXPECT_DOUBLE_EQ(si.bias_instability.y(), units::kDeg);
  EXPECT_DOUBLE_EQ(si.bias_per_deg_c.z(), units::kDeg);
  EXPECT_DOUBLE_EQ(si.random_walk.y(), units::kDeg);
  EXPECT_DOUBLE_EQ(si.scale_factor.z(), 0.1);
  EXPECT_DOUBLE_EQ(si.scale_factor_asymmetry.z(), 0.2);
  EXPECT_DOUBLE_EQ(si.cross_axis_rad[5], units::kDeg);
  EXPECT_DOUBLE_EQ(si.full_scale.x(), 400.0 * units::kDeg);
  EXPECT_DOUBLE_EQ(si.quantization.x(), units::kDeg);
}

TEST(TriadParameters, UnitsOfAccelerometerDataSheetsBecomeSi) {
  AccelErrors accel;
  accel.bias_gm_sigma_mgal.setConstant(1e5);
  accel.bias_random_walk_mgal_per_sqrt_h.setConstant(60e5);
  accel.vrw_m_per_s_per_sqrt_h.setConstant(60.0);
  accel.nonlinearity_ppm_per_g.setConstant(9.80665e6);
  accel.full_scale_g.setConstant(10.0);
  accel.quantization_m_per_s.setConstant(0.002);
  const TriadParameters si = in_si(accel);
  EXPECT_DOUBLE_EQ(si.bias_gm_sigma.x(), 1.0);
  EXPECT_DOUBLE_EQ(si.bias_random_walk.x(), 1.0);
  EXPECT_DOUBLE_EQ(si.random_walk.x(), 1.0);
  EXPECT_DOUBLE_EQ(si.nonlinearity_by_input.x(), 1.0);
  EXPECT_DOUBLE_EQ(si.full_scale.y(), 98.0665);
  EXPECT_DOUBLE_EQ(si.quantization.z(), 0.002);
}

}  // namespace triad_parameters_test
}  // namespace inslab::imu
