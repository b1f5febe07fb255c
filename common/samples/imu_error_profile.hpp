#pragma once

#include "samples/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// Errors of one gyro triad, in the units of data sheets. Gauss-Markov sigma is the steady-state standard deviation.
struct GyroErrors {
  Vector3 bias_constant_deg_per_h = Vector3::Zero();
  Vector3 bias_turn_on_sigma_deg_per_h = Vector3::Zero();
  Vector3 bias_gm_sigma_deg_per_h = Vector3::Zero();
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 arw_deg_per_sqrt_h = Vector3::Zero();
  Vector3 scale_factor_ppm = Vector3::Zero();
  Vector6 cross_axis_arcsec = Vector6::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("bias_constant_deg_per_h", "fixed bias").in(-1e6, 1e6), self.bias_constant_deg_per_h);
    visit(Field("bias_turn_on_sigma_deg_per_h", "standard deviation of a constant drawn once a run").in(0.0, 1e6),
          self.bias_turn_on_sigma_deg_per_h);
    visit(
        Field("bias_gm_sigma_deg_per_h", "first-order Gauss-Markov bias: steady-state standard deviation").in(0.0, 1e6),
        self.bias_gm_sigma_deg_per_h);
    visit(Field("bias_gm_correlation_time_s", "first-order Gauss-Markov bias: correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.bias_gm_correlation_time_s);
    visit(Field("arw_deg_per_sqrt_h", "angle random walk: white noise of the rate").in(0.0, 1e3),
          self.arw_deg_per_sqrt_h);
    visit(Field("scale_factor_ppm", "scale factor error").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("cross_axis_arcsec", "small angles of sensitive axes: x to y, x to z, y to x, y to z, z to x, z to y")
              .in(-36000.0, 36000.0),
          self.cross_axis_arcsec);
  }
};

/// Errors of one accelerometer triad, in the units of data sheets; 1 mGal = 1e-5 m/s^2.
struct AccelErrors {
  Vector3 bias_constant_mgal = Vector3::Zero();
  Vector3 bias_turn_on_sigma_mgal = Vector3::Zero();
  Vector3 bias_gm_sigma_mgal = Vector3::Zero();
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 vrw_m_per_s_per_sqrt_h = Vector3::Zero();
  Vector3 scale_factor_ppm = Vector3::Zero();
  Vector6 cross_axis_arcsec = Vector6::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("bias_constant_mgal", "fixed bias").in(-1e7, 1e7), self.bias_constant_mgal);
    visit(Field("bias_turn_on_sigma_mgal", "standard deviation of a constant drawn once a run").in(0.0, 1e7),
          self.bias_turn_on_sigma_mgal);
    visit(Field("bias_gm_sigma_mgal", "first-order Gauss-Markov bias: steady-state standard deviation").in(0.0, 1e7),
          self.bias_gm_sigma_mgal);
    visit(Field("bias_gm_correlation_time_s", "first-order Gauss-Markov bias: correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.bias_gm_correlation_time_s);
    visit(Field("vrw_m_per_s_per_sqrt_h", "velocity random walk: white noise of the specific force").in(0.0, 1e3),
          self.vrw_m_per_s_per_sqrt_h);
    visit(Field("scale_factor_ppm", "scale factor error").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("cross_axis_arcsec", "small angles of sensitive axes: x to y, x to z, y to x, y to z, z to x, z to y")
              .in(-36000.0, 36000.0),
          self.cross_axis_arcsec);
  }
};

/// How one IMU errs: topic inslab/profile/imu_error and the files of config/profiles/imu.
struct ImuErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::ImuError;

  SensorAddress target{SensorKind::Imu, 0};
  ProfileRequest request;
  std::string name;
  std::string source;  ///< where the figures come from; stays in the file
  GyroErrors gyro;
  AccelErrors accel;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("gyro", "gyro triad"), self.gyro);
    visit(Field("accel", "accelerometer triad"), self.accel);
  }
};

}  // namespace samples
}  // namespace inslab
