#include "inslab/models/navigation/matching_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/matching_uses.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {

namespace {

Vector3 root_sum_square(std::initializer_list<Vector3> terms) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& term : terms) sum += term.cwiseAbs2();
  return sum.cwiseSqrt();
}

/// Per axis, what 1 g, whichever way it points, adds to a gyro's bias, deg/h.
Vector3 by_gravity_deg_per_h(const Vector9& deg_per_h_per_g) {
  return {deg_per_h_per_g.segment<3>(0).norm(), deg_per_h_per_g.segment<3>(3).norm(),
          deg_per_h_per_g.segment<3>(6).norm()};
}

/// How far the course of the temperature leads from where the sensors are calibrated.
double warming_deg_c(const std::vector<TemperaturePoint>& corners) {
  constexpr double kCalibratedAt_deg_c = 20.0;  // as the profile's terms are set
  double most = 0.0;
  for (const TemperaturePoint& corner : corners) {
    most = std::max(most, std::abs(corner.temperature_deg_c - kCalibratedAt_deg_c));
  }
  return most;
}

/// Per axis, what its two cross-axis angles add to a scale factor, ppm.
Vector3 cross_axis_ppm(const Vector6& arcsec) {
  const Vector6 ppm = arcsec * (units::kArcsec / units::kPpm);
  return {std::hypot(ppm[0], ppm[1]), std::hypot(ppm[2], ppm[3]), std::hypot(ppm[4], ppm[5])};
}

}  // namespace

NavigationParameters matching_parameters(const ImuErrorProfile& imu, const InstallationProfile& imu_place,
                                         const InstallationProfile& antenna_place) {
  NavigationParameters p;
  p.name = imu.name;
  p.source = "matches the profile " + imu.name;
  const GyroErrors& g = imu.gyro;
  const double warming = warming_deg_c(imu.temperature);
  p.gyro.arw_deg_per_sqrt_h = g.arw_deg_per_sqrt_h;
  p.gyro.bias_sigma_deg_per_h = root_sum_square(
      {g.bias_constant_deg_per_h, g.bias_turn_on_sigma_deg_per_h, g.bias_gm_sigma_deg_per_h,
       g.bias_instability_deg_per_h, g.bias_random_walk_deg_per_h_per_sqrt_h,
       warming * g.bias_temperature_deg_per_h_per_deg_c, by_gravity_deg_per_h(g.g_sensitivity_deg_per_h_per_g)});
  p.gyro.bias_correlation_time_s = g.bias_gm_correlation_time_s;
  p.gyro.scale_factor_sigma_ppm = root_sum_square({g.scale_factor_ppm, g.scale_factor_turn_on_sigma_ppm,
                                                   g.scale_factor_gm_sigma_ppm, g.nonlinearity_ppm_of_full_scale,
                                                   g.scale_factor_asymmetry_ppm, cross_axis_ppm(g.cross_axis_arcsec)});
  p.gyro.scale_factor_correlation_time_s = g.scale_factor_gm_correlation_time_s;
  const AccelErrors& a = imu.accel;
  p.accel.vrw_m_per_s_per_sqrt_h = a.vrw_m_per_s_per_sqrt_h;
  p.accel.bias_sigma_mgal =
      root_sum_square({a.bias_constant_mgal, a.bias_turn_on_sigma_mgal, a.bias_gm_sigma_mgal, a.bias_instability_mgal,
                       a.bias_random_walk_mgal_per_sqrt_h, warming * a.bias_temperature_mgal_per_deg_c});
  p.accel.bias_correlation_time_s = a.bias_gm_correlation_time_s;
  p.accel.scale_factor_sigma_ppm = root_sum_square({a.scale_factor_ppm, a.scale_factor_turn_on_sigma_ppm,
                                                    a.scale_factor_gm_sigma_ppm, a.nonlinearity_ppm_of_full_scale,
                                                    a.scale_factor_asymmetry_ppm, cross_axis_ppm(a.cross_axis_arcsec)});
  p.accel.scale_factor_correlation_time_s = a.scale_factor_gm_correlation_time_s;

  const Vector3 rpy_rad = units::kDeg * imu_place.mounting_rpy_deg;
  const Matrix3 C_vb = nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()});
  p.lever_arm_b_m = C_vb.transpose() * (antenna_place.lever_arm_v_m - imu_place.lever_arm_v_m);
  return p;
}

std::vector<std::string> left_out_of_matching(const catalog::AnyProfile& profile) {
  return std::visit(
      [](const auto& one) {
        return profiles::names_left_out(matching::uses_of(Tag<std::decay_t<decltype(one)>>{}), one);
      },
      profile);
}

}  // namespace inslab::navigation
