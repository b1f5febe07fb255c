#pragma once

#include "inslab/data/profiles/recorded_error.hpp"
#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// The low-pass filter of a sensor's bandwidth: one pole, or two with Butterworth's damping of sqrt(1/2).
enum class FilterOrder : std::uint32_t { First, Second };

template <>
struct EnumNames<FilterOrder> {
  static constexpr std::string_view type = "FilterOrder";
  static constexpr std::string_view prefix = "FILTER_";
  static constexpr std::array<std::string_view, 2> values{"first", "second"};
};

/// Errors of one gyro triad, in the units of data sheets. Gauss-Markov sigma is the steady-state standard deviation;
/// what each term does to the output stands in common/models/imu, one header a term.
struct GyroErrors {
  Vector3 bias_constant_deg_per_h = Vector3::Zero();
  Vector3 bias_turn_on_sigma_deg_per_h = Vector3::Zero();
  Vector3 bias_gm_sigma_deg_per_h = Vector3::Zero();
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 bias_random_walk_deg_per_h_per_sqrt_h = Vector3::Zero();
  Vector3 bias_instability_deg_per_h = Vector3::Zero();
  Vector3 bias_temperature_deg_per_h_per_deg_c = Vector3::Zero();
  Vector3 arw_deg_per_sqrt_h = Vector3::Zero();
  Vector3 scale_factor_ppm = Vector3::Zero();
  Vector3 scale_factor_turn_on_sigma_ppm = Vector3::Zero();
  Vector3 scale_factor_gm_sigma_ppm = Vector3::Zero();
  Vector3 scale_factor_gm_correlation_time_s = Vector3::Zero();
  Vector3 scale_factor_temperature_ppm_per_deg_c = Vector3::Zero();
  Vector3 scale_factor_asymmetry_ppm = Vector3::Zero();
  Vector3 nonlinearity_ppm_of_full_scale = Vector3::Zero();
  Vector6 cross_axis_arcsec = Vector6::Zero();
  Vector9 g_sensitivity_deg_per_h_per_g = Vector9::Zero();
  Vector3 bandwidth_hz = Vector3::Zero();
  FilterOrder bandwidth_order = FilterOrder::First;
  Vector3 full_scale_deg_per_s = Vector3::Zero();
  Vector3 quantization_arcsec = Vector3::Zero();

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
    visit(Field("bias_random_walk_deg_per_h_per_sqrt_h", "random walk of the bias (rate random walk), from 0")
              .in(0.0, 1e6),
          self.bias_random_walk_deg_per_h_per_sqrt_h);
    visit(Field("bias_instability_deg_per_h",
                "flicker of the bias: B, whose Allan deviation is 0.664 B from one sample to 20000 s")
              .in(0.0, 1e6),
          self.bias_instability_deg_per_h);
    visit(Field("bias_temperature_deg_per_h_per_deg_c", "bias by temperature above 20 deg C").in(-1e5, 1e5),
          self.bias_temperature_deg_per_h_per_deg_c);
    visit(Field("arw_deg_per_sqrt_h", "angle random walk: white noise of the rate").in(0.0, 1e3),
          self.arw_deg_per_sqrt_h);
    visit(Field("scale_factor_ppm", "scale factor error").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("scale_factor_turn_on_sigma_ppm", "standard deviation of a scale factor error drawn once a run")
              .in(0.0, 5e5),
          self.scale_factor_turn_on_sigma_ppm);
    visit(Field("scale_factor_gm_sigma_ppm", "first-order Gauss-Markov scale factor: steady-state standard deviation")
              .in(0.0, 5e5),
          self.scale_factor_gm_sigma_ppm);
    visit(Field("scale_factor_gm_correlation_time_s",
                "first-order Gauss-Markov scale factor: correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.scale_factor_gm_correlation_time_s);
    visit(Field("scale_factor_temperature_ppm_per_deg_c", "scale factor error by temperature above 20 deg C")
              .in(-1e4, 1e4),
          self.scale_factor_temperature_ppm_per_deg_c);
    visit(
        Field("scale_factor_asymmetry_ppm", "scale factor of positive rates less that of negative ones").in(-5e5, 5e5),
        self.scale_factor_asymmetry_ppm);
    visit(Field("nonlinearity_ppm_of_full_scale", "departure from a straight line at full scale, a cubic below")
              .in(-5e5, 5e5),
          self.nonlinearity_ppm_of_full_scale);
    visit(Field("cross_axis_arcsec", "small angles of sensitive axes: x to y, x to z, y to x, y to z, z to x, z to y")
              .in(-36000.0, 36000.0),
          self.cross_axis_arcsec);
    visit(Field("g_sensitivity_deg_per_h_per_g",
                "bias by specific force, 3x3 row by row: of gyro x along x, y, z, of gyro y, of gyro z")
              .in(-1e6, 1e6),
          self.g_sensitivity_deg_per_h_per_g);
    visit(Field("bandwidth_hz", "of the low-pass filter: -3 dB; 0: none").in(0.0, 1e5), self.bandwidth_hz);
    visit(Field("bandwidth_order", "of the low-pass filter: one pole, or two (Butterworth)"), self.bandwidth_order);
    visit(Field("full_scale_deg_per_s", "the largest mean rate it puts out; 0: no limit").in(0.0, 1e6),
          self.full_scale_deg_per_s);
    visit(Field("quantization_arcsec", "one count of the increment; 0: none").in(0.0, 36000.0),
          self.quantization_arcsec);
  }
};

/// Errors of one accelerometer triad, in the units of data sheets; 1 mGal = 1e-5 m/s^2, 1 g = 9.80665 m/s^2.
struct AccelErrors {
  Vector3 bias_constant_mgal = Vector3::Zero();
  Vector3 bias_turn_on_sigma_mgal = Vector3::Zero();
  Vector3 bias_gm_sigma_mgal = Vector3::Zero();
  Vector3 bias_gm_correlation_time_s = Vector3::Zero();
  Vector3 bias_random_walk_mgal_per_sqrt_h = Vector3::Zero();
  Vector3 bias_instability_mgal = Vector3::Zero();
  Vector3 bias_temperature_mgal_per_deg_c = Vector3::Zero();
  Vector3 vrw_m_per_s_per_sqrt_h = Vector3::Zero();
  Vector3 scale_factor_ppm = Vector3::Zero();
  Vector3 scale_factor_turn_on_sigma_ppm = Vector3::Zero();
  Vector3 scale_factor_gm_sigma_ppm = Vector3::Zero();
  Vector3 scale_factor_gm_correlation_time_s = Vector3::Zero();
  Vector3 scale_factor_temperature_ppm_per_deg_c = Vector3::Zero();
  Vector3 scale_factor_asymmetry_ppm = Vector3::Zero();
  Vector3 nonlinearity_ppm_of_full_scale = Vector3::Zero();
  Vector3 nonlinearity_ppm_per_g = Vector3::Zero();
  Vector6 cross_axis_arcsec = Vector6::Zero();
  Vector3 bandwidth_hz = Vector3::Zero();
  FilterOrder bandwidth_order = FilterOrder::First;
  Vector3 full_scale_g = Vector3::Zero();
  Vector3 quantization_m_per_s = Vector3::Zero();

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
    visit(Field("bias_random_walk_mgal_per_sqrt_h", "random walk of the bias (acceleration random walk), from 0")
              .in(0.0, 1e7),
          self.bias_random_walk_mgal_per_sqrt_h);
    visit(Field("bias_instability_mgal",
                "flicker of the bias: B, whose Allan deviation is 0.664 B from one sample to 20000 s")
              .in(0.0, 1e7),
          self.bias_instability_mgal);
    visit(Field("bias_temperature_mgal_per_deg_c", "bias by temperature above 20 deg C").in(-1e6, 1e6),
          self.bias_temperature_mgal_per_deg_c);
    visit(Field("vrw_m_per_s_per_sqrt_h", "velocity random walk: white noise of the specific force").in(0.0, 1e3),
          self.vrw_m_per_s_per_sqrt_h);
    visit(Field("scale_factor_ppm", "scale factor error").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("scale_factor_turn_on_sigma_ppm", "standard deviation of a scale factor error drawn once a run")
              .in(0.0, 5e5),
          self.scale_factor_turn_on_sigma_ppm);
    visit(Field("scale_factor_gm_sigma_ppm", "first-order Gauss-Markov scale factor: steady-state standard deviation")
              .in(0.0, 5e5),
          self.scale_factor_gm_sigma_ppm);
    visit(Field("scale_factor_gm_correlation_time_s",
                "first-order Gauss-Markov scale factor: correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.scale_factor_gm_correlation_time_s);
    visit(Field("scale_factor_temperature_ppm_per_deg_c", "scale factor error by temperature above 20 deg C")
              .in(-1e4, 1e4),
          self.scale_factor_temperature_ppm_per_deg_c);
    visit(
        Field("scale_factor_asymmetry_ppm", "scale factor of positive forces less that of negative ones").in(-5e5, 5e5),
        self.scale_factor_asymmetry_ppm);
    visit(Field("nonlinearity_ppm_of_full_scale", "departure from a straight line at full scale, a cubic below")
              .in(-5e5, 5e5),
          self.nonlinearity_ppm_of_full_scale);
    visit(Field("nonlinearity_ppm_per_g", "growth of the scale factor with the force: a square").in(-1e5, 1e5),
          self.nonlinearity_ppm_per_g);
    visit(Field("cross_axis_arcsec", "small angles of sensitive axes: x to y, x to z, y to x, y to z, z to x, z to y")
              .in(-36000.0, 36000.0),
          self.cross_axis_arcsec);
    visit(Field("bandwidth_hz", "of the low-pass filter: -3 dB; 0: none").in(0.0, 1e5), self.bandwidth_hz);
    visit(Field("bandwidth_order", "of the low-pass filter: one pole, or two (Butterworth)"), self.bandwidth_order);
    visit(Field("full_scale_g", "the largest mean force it puts out, 1 g or more; 0: no limit").in(0.0, 1e6),
          self.full_scale_g);
    visit(Field("quantization_m_per_s", "one count of the increment; 0: none").in(0.0, 10.0),
          self.quantization_m_per_s);
  }
};

/// A corner of the temperature's course: straight lines between them, constant before the first and after the last.
struct TemperaturePoint {
  double at_s = 0.0;
  double temperature_deg_c = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("at_s", "sim time").in(0.0, 1e9).required(), self.at_s);
    visit(Field("temperature_deg_c", "of the sensors").in(-100.0, 200.0).required(), self.temperature_deg_c);
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
  std::vector<TemperaturePoint> temperature;
  double latency_s = 0.0;
  double drop_probability = 0.0;
  double accel_delay_s = 0.0;
  Vector9 accel_place_m = Vector9::Zero();
  Vector6 gyro_cross_axis_gm_sigma_arcsec = Vector6::Zero();
  Vector6 gyro_cross_axis_gm_correlation_time_s = Vector6::Zero();
  Vector6 accel_cross_axis_gm_sigma_arcsec = Vector6::Zero();
  Vector6 accel_cross_axis_gm_correlation_time_s = Vector6::Zero();
  Vector3 gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min = Vector3::Zero();
  Vector3 accel_bias_temperature_rate_mgal_per_deg_c_per_min = Vector3::Zero();
  Vector3 gyro_bias_hysteresis_deg_per_h = Vector3::Zero();
  Vector3 accel_bias_hysteresis_mgal = Vector3::Zero();
  double bias_hysteresis_width_deg_c = 5.0;
  Vector3 accel_rectification_mgal_per_g2 = Vector3::Zero();
  Vector9 gyro_g2_sensitivity_deg_per_h_per_g2 = Vector9::Zero();
  Vector9 gyro_anisoelasticity_deg_per_h_per_g2 = Vector9::Zero();
  Vector9 gyro_anisoinertia_deg_per_h_per_deg2_per_s2 = Vector9::Zero();
  RecordedError recorded_error;
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("gyro", "gyro triad"), self.gyro);
    visit(Field("accel", "accelerometer triad"), self.accel);
    visit(Field("temperature", "course of the temperature; none: 20 deg C").at_most(64), self.temperature);
    visit(Field("latency_s", "from the end of the interval to delivery").in(0.0, 1.0), self.latency_s);
    visit(Field("drop_probability", "of each sample: it comes without increments, marked as not valid").in(0.0, 1.0),
          self.drop_probability);
    visit(Field("accel_delay_s",
                "how much later than the gyros the accelerometers felt what they put out; below 0: "
                "earlier")
              .in(-0.005, 0.005)
              .appended(),
          self.accel_delay_s);
    visit(Field("accel_place_m",
                "where each accelerometer sits from the IMU's point (size effect), 3x3 row by row: x, y, z of "
                "accelerometer x, of accelerometer y, of accelerometer z")
              .in(-1.0, 1.0)
              .appended(),
          self.accel_place_m);
    visit(Field("gyro_cross_axis_gm_sigma_arcsec",
                "first-order Gauss-Markov angles of the gyros, in the order of cross_axis_arcsec: steady-state "
                "standard deviation")
              .in(0.0, 36000.0)
              .appended(),
          self.gyro_cross_axis_gm_sigma_arcsec);
    visit(Field("gyro_cross_axis_gm_correlation_time_s", "their correlation time; above 0 where sigma is")
              .in(0.0, 1e7)
              .appended(),
          self.gyro_cross_axis_gm_correlation_time_s);
    visit(Field("accel_cross_axis_gm_sigma_arcsec", "the same of the accelerometers").in(0.0, 36000.0).appended(),
          self.accel_cross_axis_gm_sigma_arcsec);
    visit(Field("accel_cross_axis_gm_correlation_time_s", "their correlation time; above 0 where sigma is")
              .in(0.0, 1e7)
              .appended(),
          self.accel_cross_axis_gm_correlation_time_s);
    visit(Field("gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min",
                "bias while the temperature rises by 1 deg C a minute")
              .in(-1e5, 1e5)
              .appended(),
          self.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min);
    visit(Field("accel_bias_temperature_rate_mgal_per_deg_c_per_min", "the same of the accelerometers")
              .in(-1e6, 1e6)
              .appended(),
          self.accel_bias_temperature_rate_mgal_per_deg_c_per_min);
    visit(Field("gyro_bias_hysteresis_deg_per_h",
                "bias while it gets warmer less that while it gets colder, at one temperature")
              .in(-1e5, 1e5)
              .appended(),
          self.gyro_bias_hysteresis_deg_per_h);
    visit(Field("accel_bias_hysteresis_mgal", "the same of the accelerometers").in(-1e6, 1e6).appended(),
          self.accel_bias_hysteresis_mgal);
    visit(Field("bias_hysteresis_width_deg_c",
                "over how much of a turning temperature the bias goes from one to the other")
              .in(0.01, 300.0)
              .appended(),
          self.bias_hysteresis_width_deg_c);
    visit(Field("accel_rectification_mgal_per_g2",
                "bias by the mean square of the vibration along the axis, as far as it is within an interval")
              .in(-1e6, 1e6)
              .appended(),
          self.accel_rectification_mgal_per_g2);
    visit(Field("gyro_g2_sensitivity_deg_per_h_per_g2",
                "bias by the squares of the specific force, 3x3 row by row: of gyro x by those along x, y, z, of gyro "
                "y, of gyro z")
              .in(-1e6, 1e6)
              .appended(),
          self.gyro_g2_sensitivity_deg_per_h_per_g2);
    visit(
        Field(
            "gyro_anisoelasticity_deg_per_h_per_g2",
            "bias by products of the specific force, 3x3 row by row: of gyro x by y z, z x, x y, of gyro y, of gyro z")
            .in(-1e6, 1e6)
            .appended(),
        self.gyro_anisoelasticity_deg_per_h_per_g2);
    visit(
        Field("gyro_anisoinertia_deg_per_h_per_deg2_per_s2",
              "bias by products of the angular rate, 3x3 row by row: of gyro x by y z, z x, x y, of gyro y, of gyro z")
            .in(-1e3, 1e3)
            .appended(),
        self.gyro_anisoinertia_deg_per_h_per_deg2_per_s2);
    visit(Field("recorded_error", "errors of a real IMU, recorded, on top of the others").appended(),
          self.recorded_error);
    visit(Field("time_tag", "of the clock that tags the samples").appended(), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
