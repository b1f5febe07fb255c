#include "inslab/models/navigation/matching_parameters.hpp"

#include <gtest/gtest.h>

#include "inslab/foundation/units/units.hpp"

namespace inslab::navigation {
namespace matching_parameters_test {

NavigationParameters matching(const std::function<void(ImuErrorProfile&)>& change) {
  ImuErrorProfile imu;
  change(imu);
  return matching_parameters(imu, {}, {});
}

const Vector3 kTerm(3.0, 4.0, 12.0);

/// A term of a triad's profile, and what of the parameters it alone decides.
struct Term {
  const char* name;
  std::function<Vector3&(ImuErrorProfile&)> term;
  std::function<Vector3(const NavigationParameters&)> parameter;
};

std::vector<Term> terms() {
  const auto gyro_bias = [](const NavigationParameters& p) { return p.gyro.bias_sigma_deg_per_h; };
  const auto gyro_scale = [](const NavigationParameters& p) { return p.gyro.scale_factor_sigma_ppm; };
  const auto accel_bias = [](const NavigationParameters& p) { return p.accel.bias_sigma_mgal; };
  const auto accel_scale = [](const NavigationParameters& p) { return p.accel.scale_factor_sigma_ppm; };
  const auto gyro = [](Vector3 GyroErrors::*field) {
    return [field](ImuErrorProfile& imu) -> Vector3& { return imu.gyro.*field; };
  };
  const auto accel = [](Vector3 AccelErrors::*field) {
    return [field](ImuErrorProfile& imu) -> Vector3& { return imu.accel.*field; };
  };
  return {
      {"gyro arw", gyro(&GyroErrors::arw_deg_per_sqrt_h),
       [](const NavigationParameters& p) { return p.gyro.arw_deg_per_sqrt_h; }},
      {"gyro bias_constant", gyro(&GyroErrors::bias_constant_deg_per_h), gyro_bias},
      {"gyro bias_turn_on", gyro(&GyroErrors::bias_turn_on_sigma_deg_per_h), gyro_bias},
      {"gyro bias_gm_sigma", gyro(&GyroErrors::bias_gm_sigma_deg_per_h), gyro_bias},
      {"gyro bias_instability", gyro(&GyroErrors::bias_instability_deg_per_h), gyro_bias},
      {"gyro bias_random_walk, an hour of it", gyro(&GyroErrors::bias_random_walk_deg_per_h_per_sqrt_h), gyro_bias},
      {"gyro bias_gm_correlation_time", gyro(&GyroErrors::bias_gm_correlation_time_s),
       [](const NavigationParameters& p) { return p.gyro.bias_correlation_time_s; }},
      {"gyro scale_factor", gyro(&GyroErrors::scale_factor_ppm), gyro_scale},
      {"gyro scale_factor_turn_on", gyro(&GyroErrors::scale_factor_turn_on_sigma_ppm), gyro_scale},
      {"gyro scale_factor_gm_sigma", gyro(&GyroErrors::scale_factor_gm_sigma_ppm), gyro_scale},
      {"gyro nonlinearity", gyro(&GyroErrors::nonlinearity_ppm_of_full_scale), gyro_scale},
      {"gyro asymmetry", gyro(&GyroErrors::scale_factor_asymmetry_ppm), gyro_scale},
      {"gyro scale_factor_gm_correlation_time", gyro(&GyroErrors::scale_factor_gm_correlation_time_s),
       [](const NavigationParameters& p) { return p.gyro.scale_factor_correlation_time_s; }},
      {"accel vrw", accel(&AccelErrors::vrw_m_per_s_per_sqrt_h),
       [](const NavigationParameters& p) { return p.accel.vrw_m_per_s_per_sqrt_h; }},
      {"accel bias_constant", accel(&AccelErrors::bias_constant_mgal), accel_bias},
      {"accel bias_turn_on", accel(&AccelErrors::bias_turn_on_sigma_mgal), accel_bias},
      {"accel bias_gm_sigma", accel(&AccelErrors::bias_gm_sigma_mgal), accel_bias},
      {"accel bias_instability", accel(&AccelErrors::bias_instability_mgal), accel_bias},
      {"accel bias_random_walk, an hour of it", accel(&AccelErrors::bias_random_walk_mgal_per_sqrt_h), accel_bias},
      {"accel bias_gm_correlation_time", accel(&AccelErrors::bias_gm_correlation_time_s),
       [](const NavigationParameters& p) { return p.accel.bias_correlation_time_s; }},
      {"accel scale_factor", accel(&AccelErrors::scale_factor_ppm), accel_scale},
      {"accel scale_factor_turn_on", accel(&AccelErrors::scale_factor_turn_on_sigma_ppm), accel_scale},
      {"accel scale_factor_gm_sigma", accel(&AccelErrors::scale_factor_gm_sigma_ppm), accel_scale},
      {"accel nonlinearity", accel(&AccelErrors::nonlinearity_ppm_of_full_scale), accel_scale},
      {"accel asymmetry", accel(&AccelErrors::scale_factor_asymmetry_ppm), accel_scale},
      {"accel scale_factor_gm_correlation_time", accel(&AccelErrors::scale_factor_gm_correlation_time_s),
       [](const NavigationParameters& p) { return p.accel.scale_factor_correlation_time_s; }},
  };
}

/// All sensor parameters in one column.
Eigen::Matrix<double, 30, 1> sensors_of(const NavigationParameters& p) {
  Eigen::Matrix<double, 30, 1> all;
  all << p.gyro.arw_deg_per_sqrt_h, p.gyro.bias_sigma_deg_per_h, p.gyro.bias_correlation_time_s,
      p.gyro.scale_factor_sigma_ppm, p.gyro.scale_factor_correlation_time_s, p.accel.vrw_m_per_s_per_sqrt_h,
      p.accel.bias_sigma_mgal, p.accel.bias_correlation_time_s, p.accel.scale_factor_sigma_ppm,
      p.accel.scale_factor_correlation_time_s;
  return all;
}

TEST(MatchingParameters, APerfectImuHasNoErrors) {
  EXPECT_EQ(sensors_of(matching([](ImuErrorProfile&) {})).norm(), 0.0);
}

TEST(MatchingParameters, EachTermAloneIsItsParameterAndNoOther) {
  for (const Term& term : terms()) {
    const NavigationParameters p = matching([&](ImuErrorProfile& imu) { term.term(imu) = kTerm; });
    EXPECT_LT((term.parameter(p) - kTerm).norm(), 1e-14) << term.name;
    EXPECT_NEAR(sensors_of(p).norm(), kTerm.norm(), 1e-14) << term.name;
  }
}

// 3, 4, 12 and 84 make 13 and 85: the root of the sum of squares, axis by axis.
TEST(MatchingParameters, TermsOfOneErrorAddAsTheirSquares) {
  const NavigationParameters p = matching([](ImuErrorProfile& imu) {
    imu.gyro.bias_constant_deg_per_h = Vector3(-3.0, 0.0, 3.0);
    imu.gyro.bias_turn_on_sigma_deg_per_h = Vector3(4.0, 5.0, 4.0);
    imu.gyro.bias_gm_sigma_deg_per_h = Vector3(12.0, 12.0, 12.0);
    imu.gyro.bias_instability_deg_per_h = Vector3(84.0, 0.0, 0.0);
  });
  EXPECT_LT((p.gyro.bias_sigma_deg_per_h - Vector3(85.0, 13.0, 13.0)).norm(), 1e-13);
}

// 15 deg C above 20 at most; 1 g along any axis: 3, 4, 12 make 13.
TEST(MatchingParameters, WarmingAndGravityCountAsABias) {
  const NavigationParameters p = matching([](ImuErrorProfile& imu) {
    imu.temperature = {{0.0, 10.0}, {600.0, 35.0}, {900.0, 30.0}};
    imu.gyro.bias_temperature_deg_per_h_per_deg_c = Vector3(0.4, 0.0, -0.2);
    imu.gyro.g_sensitivity_deg_per_h_per_g << 0.0, 0.0, 8.0, 3.0, -4.0, 12.0, 0.0, 4.0, 0.0;
    imu.accel.bias_temperature_mgal_per_deg_c = Vector3(1.0, -2.0, 0.0);
  });
  EXPECT_LT((p.gyro.bias_sigma_deg_per_h - Vector3(10.0, 13.0, 5.0)).norm(), 1e-13);
  EXPECT_LT((p.accel.bias_sigma_mgal - Vector3(15.0, 30.0, 0.0)).norm(), 1e-13);
}

// An angle e couples an axis into another by e rad, a part of its own size: xy and xz belong to x. 3 and 4 arcsec
// are 5.
TEST(MatchingParameters, CrossAxisAnglesCountAsAScaleFactorOfTheirAxis) {
  const double ppm_per_arcsec = units::kArcsec / units::kPpm;
  const NavigationParameters p = matching([](ImuErrorProfile& imu) {
    imu.gyro.cross_axis_arcsec << 3.0, 4.0, 0.0, 5.0, -6.0, 8.0;
    imu.accel.cross_axis_arcsec << 0.0, -1.0, 3.0, 4.0, 0.0, 0.0;
  });
  EXPECT_LT((p.gyro.scale_factor_sigma_ppm - ppm_per_arcsec * Vector3(5.0, 5.0, 10.0)).norm(), 1e-10);
  EXPECT_LT((p.accel.scale_factor_sigma_ppm - ppm_per_arcsec * Vector3(1.0, 5.0, 0.0)).norm(), 1e-10);
}

// The IMU looks to the right: its x is the vehicle's y and its y the vehicle's -x.
TEST(MatchingParameters, TheLeverArmIsFromTheImuToTheAntennaInTheImusAxes) {
  InstallationProfile imu_place, antenna_place;
  imu_place.lever_arm_v_m = Vector3(-0.5, 0.25, -0.25);
  imu_place.mounting_rpy_deg = Vector3(0.0, 0.0, 90.0);
  antenna_place.lever_arm_v_m = Vector3(1.0, 0.5, -1.5);
  const NavigationParameters p = matching_parameters({}, imu_place, antenna_place);
  EXPECT_LT((p.lever_arm_b_m - Vector3(0.25, -1.5, -1.25)).norm(), 1e-15);
}

}  // namespace matching_parameters_test
}  // namespace inslab::navigation
