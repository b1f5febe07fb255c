#pragma once

#include <optional>
#include <string>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/models/navigation/barometer_belief.hpp"
#include "inslab/models/navigation/gravity_belief.hpp"
#include "inslab/models/navigation/heading_belief.hpp"
#include "inslab/models/navigation/magnetometer_belief.hpp"
#include "inslab/models/navigation/odometer_belief.hpp"

/// The reference navigation app: a loosely coupled error-state Kalman filter without bus, clock or files.
namespace inslab::navigation {

/// What the filter believes of a gyro triad. Gauss-Markov sigma is the steady-state standard deviation, and also what
/// the state begins with; a correlation time of 0 stands for a constant.
struct GyroModel {
  Vector3 arw_deg_per_sqrt_h = Vector3::Constant(0.15);
  Vector3 bias_sigma_deg_per_h = Vector3::Constant(1.0);
  Vector3 bias_correlation_time_s = Vector3::Constant(3600.0);
  Vector3 scale_factor_sigma_ppm = Vector3::Constant(300.0);
  Vector3 scale_factor_correlation_time_s = Vector3::Constant(3600.0);

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("arw_deg_per_sqrt_h", "angle random walk").in(0.0, 1e3), self.arw_deg_per_sqrt_h);
    visit(Field("bias_sigma_deg_per_h", "Gauss-Markov bias: steady-state and initial standard deviation").in(0.0, 1e6),
          self.bias_sigma_deg_per_h);
    visit(Field("bias_correlation_time_s", "0: a constant").in(0.0, 1e7), self.bias_correlation_time_s);
    visit(Field("scale_factor_sigma_ppm", "Gauss-Markov scale factor: steady-state and initial standard deviation")
              .in(0.0, 5e5),
          self.scale_factor_sigma_ppm);
    visit(Field("scale_factor_correlation_time_s", "0: a constant").in(0.0, 1e7), self.scale_factor_correlation_time_s);
  }
};

/// The same of an accelerometer triad.
struct AccelModel {
  Vector3 vrw_m_per_s_per_sqrt_h = Vector3::Constant(0.07);
  Vector3 bias_sigma_mgal = Vector3::Constant(100.0);
  Vector3 bias_correlation_time_s = Vector3::Constant(3600.0);
  Vector3 scale_factor_sigma_ppm = Vector3::Constant(300.0);
  Vector3 scale_factor_correlation_time_s = Vector3::Constant(3600.0);

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("vrw_m_per_s_per_sqrt_h", "velocity random walk").in(0.0, 1e3), self.vrw_m_per_s_per_sqrt_h);
    visit(Field("bias_sigma_mgal", "Gauss-Markov bias: steady-state and initial standard deviation").in(0.0, 1e7),
          self.bias_sigma_mgal);
    visit(Field("bias_correlation_time_s", "0: a constant").in(0.0, 1e7), self.bias_correlation_time_s);
    visit(Field("scale_factor_sigma_ppm", "Gauss-Markov scale factor: steady-state and initial standard deviation")
              .in(0.0, 5e5),
          self.scale_factor_sigma_ppm);
    visit(Field("scale_factor_correlation_time_s", "0: a constant").in(0.0, 1e7), self.scale_factor_correlation_time_s);
  }
};

/// Where the initial attitude comes from.
enum class InitialAttitude : std::uint32_t { StaticAlignment, Levelled, Given };

/// How the filter begins: position and velocity are the first fix's, less the lever arm.
struct InitialState {
  static constexpr bool has_discriminator = true;

  InitialAttitude attitude = InitialAttitude::StaticAlignment;
  double alignment_s = 60.0;
  Vector3 rpy_deg = Vector3::Zero();
  Vector3 attitude_sigma_ned_deg = Vector3(0.1, 0.1, 1.0);
  Vector3 position_sigma_ned_m = Vector3::Constant(1.0);
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Constant(0.1);

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit);
};

/// Which sensor errors the filter estimates beside position, velocity and attitude: what is left out has no place in
/// its state, and is taken for 0.
struct EstimatedErrors {
  bool gyro_bias = true;
  bool accel_bias = true;
  bool gyro_scale_factor = true;
  bool accel_scale_factor = true;
  bool hard_iron = false;
  bool soft_iron = false;
  bool earth_field = false;
  bool pressure_bias = false;
  bool pressure_slope = false;
  bool wheel_scale = false;
  bool other_wheel_scale = false;
  bool wheel_axis = false;
  bool baseline_drift = false;
  bool gravity_disturbance = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("gyro_bias", "three states"), self.gyro_bias);
    visit(Field("accel_bias", "three states"), self.accel_bias);
    visit(Field("gyro_scale_factor", "three states"), self.gyro_scale_factor);
    visit(Field("accel_scale_factor", "three states"), self.accel_scale_factor);
    visit(Field("hard_iron", "three states of the magnetometer"), self.hard_iron);
    visit(Field("soft_iron", "nine states of the magnetometer"), self.soft_iron);
    visit(Field("earth_field", "three states: where the Earth's magnetic field is not that of the model"),
          self.earth_field);
    visit(Field("pressure_bias", "three states of the barometer"), self.pressure_bias);
    visit(Field("pressure_slope", "two states of the barometer: of heights, and of the speed"), self.pressure_slope);
    visit(Field("wheel_scale", "two states of the odometer: constant and drift"), self.wheel_scale);
    visit(Field("other_wheel_scale", "the same of the other odometer"), self.other_wheel_scale);
    visit(
        Field("wheel_axis", "two states of the odometer: pitch and yaw of its wheel, which slide and rise are seen in"),
        self.wheel_axis);
    visit(Field("baseline_drift", "three states of the two-antenna heading: its error that lasts"),
          self.baseline_drift);
    visit(Field("gravity_disturbance", "six states: what gravity departs from its model by, and how that changes"),
          self.gravity_disturbance);
  }
};

/// When the IMU is taken to be at rest, and what is made of it.
struct ZeroVelocity {
  bool use = true;
  double window_s = 1.0;
  double force_spread_m_per_s2 = 0.05;
  double rate_spread_deg_per_s = 0.3;
  double mean_rate_deg_per_s = 0.5;
  double speed_m_per_s = 0.3;
  double sigma_m_per_s = 0.02;
  double windows_alike = 1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("use", "zero-velocity updates"), self.use);
    visit(Field("window_s", "of the detector; one update a window").in(0.1, 60.0), self.window_s);
    visit(Field("force_spread_m_per_s2", "largest standard deviation of an axis in the window").in(0.0, 1e3),
          self.force_spread_m_per_s2);
    visit(Field("rate_spread_deg_per_s", "largest standard deviation of an axis in the window").in(0.0, 1e3),
          self.rate_spread_deg_per_s);
    visit(Field("mean_rate_deg_per_s", "largest mean rate of an axis in the window").in(0.0, 1e3),
          self.mean_rate_deg_per_s);
    visit(Field("speed_m_per_s", "largest speed of the filter's own solution: a smooth cruise feels like rest")
              .in(0.0, 1e3),
          self.speed_m_per_s);
    visit(Field("sigma_m_per_s", "of the velocity that is taken to be 0, each axis").in(1e-6, 1e2), self.sigma_m_per_s);
    visit(
        Field("windows_alike",
              "windows that err alike, as a creep does: the n-th of a rest counts with n times the variance, up to so "
              "many times; 1: each errs for itself")
            .in(1.0, 1e6),
        self.windows_alike);
  }
};

/// Innovation tests: a fix's position, and its velocity, are each refused when the squared innovation over its
/// covariance is beyond the limit; chi-square with 3 degrees of freedom.
struct InnovationTest {
  double limit = 27.88;
  std::uint32_t rejections_before_recovery = 25;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("limit", "of the squared normalised innovation; 27.88: one honest fix in 260 thousand").in(1.0, 1e9),
          self.limit);
    visit(Field("rejections_before_recovery",
                "positions refused one after the other until the next is believed and the filter's doubted")
              .in(1.0, 1e9),
          self.rejections_before_recovery);
  }
};

/// What an IMU sample without rate or force (or with a saturated one) does: the last valid one goes on, with an
/// unknown constant error of this standard deviation while it lasts.
struct Coasting {
  double rate_sigma_deg_per_s = 2.0;
  double force_sigma_m_per_s2 = 1.0;
  double max_gap_s = 1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("rate_sigma_deg_per_s", "of the rate held over").in(0.0, 1e4), self.rate_sigma_deg_per_s);
    visit(Field("force_sigma_m_per_s2", "of the specific force held over").in(0.0, 1e4), self.force_sigma_m_per_s2);
    visit(Field("max_gap_s", "missing IMU time that is bridged; after more the filter begins anew").in(0.0, 60.0),
          self.max_gap_s);
  }
};

/// Everything the filter is told: files of config/nav.
struct NavigationParameters {
  std::string name;
  std::string source;
  GyroModel gyro;
  AccelModel accel;
  MagnetometerBelief magnetometer;
  BarometerBelief barometer;
  OdometerBelief odometer;
  OdometerBelief other_odometer;
  RollingConstraint rolling_constraint;
  HeadingBelief heading;
  GravityBelief gravity_disturbance;
  EstimatedErrors states;
  Vector3 lever_arm_b_m = Vector3::Zero();
  InitialState initial;
  InnovationTest innovation_test;
  ZeroVelocity zero_velocity;
  Coasting coasting;
  double covariance_interval_s = 0.02;
  double max_latency_s = 1.0;
  double coasting_after_s = 1.5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("name", "for logs and reports").at_most(64).required(), self.name);
    visit(Field("source", "where the figures come from").at_most(512), self.source);
    visit(Field("gyro", "gyro triad"), self.gyro);
    visit(Field("accel", "accelerometer triad"), self.accel);
    visit(Field("magnetometer", "when the app has one"), self.magnetometer);
    visit(Field("barometer", "when the app has one"), self.barometer);
    visit(Field("odometer", "when the app has one"), self.odometer);
    visit(Field("other_odometer", "of the wheel across, when the app has two"), self.other_odometer);
    visit(Field("rolling_constraint", "that the odometer's wheel neither slides aside nor leaves the road"),
          self.rolling_constraint);
    visit(Field("heading", "of two antennas, when the app has it"), self.heading);
    visit(Field("gravity_disturbance", "where gravity departs from the model that the filter has of it"),
          self.gravity_disturbance);
    visit(Field("states", "sensor errors that are estimated; position, velocity and attitude always are"), self.states);
    visit(Field("lever_arm_b_m", "from the IMU's centre to the antenna, in the IMU's axes").in(-1000.0, 1000.0),
          self.lever_arm_b_m);
    visit(Field("initial", "how the filter begins"), self.initial);
    visit(Field("innovation_test", "when a fix is refused"), self.innovation_test);
    visit(Field("zero_velocity", "when the IMU is taken to be at rest"), self.zero_velocity);
    visit(Field("coasting", "IMU samples that are not valid or missing"), self.coasting);
    visit(Field("covariance_interval_s", "the covariance goes on in steps of at most this; 0: at every IMU sample")
              .in(0.0, 0.1),
          self.covariance_interval_s);
    visit(Field("max_latency_s", "older fixes are dropped; the filter keeps as much of its past").in(0.0, 10.0),
          self.max_latency_s);
    visit(Field("coasting_after_s", "without an accepted fix the mode is coasting").in(0.0, 1e5),
          self.coasting_after_s);
  }
};

template <class Self, class Visitor>
void InitialState::fields(Self& self, Visitor& visit) {
  visit(Field("attitude",
              "static_alignment: from gravity and the Earth's rate at rest; levelled: roll and pitch from gravity, yaw "
              "given; given: all three"),
        self.attitude);
  if (self.attitude != InitialAttitude::Given) {
    visit(Field("alignment_s", "length of the rest that the run begins with").in(0.1, 3600.0), self.alignment_s);
  }
  if (self.attitude != InitialAttitude::StaticAlignment) {
    visit(Field("rpy_deg", "roll, pitch, yaw of the IMU").in(-360.0, 360.0), self.rpy_deg);
  }
  visit(Field("attitude_sigma_ned_deg", "of the initial attitude, about north, east, down").in(0.0, 180.0),
        self.attitude_sigma_ned_deg);
  visit(Field("position_sigma_ned_m", "of the initial position, at least").in(0.0, 1e6), self.position_sigma_ned_m);
  visit(Field("velocity_sigma_ned_m_per_s", "of the initial velocity, at least").in(0.0, 1e3),
        self.velocity_sigma_ned_m_per_s);
}

/// The first rule that the parameters break and that no single field's limits express, or nothing.
std::optional<Violation> violation(const NavigationParameters& parameters);

}  // namespace inslab::navigation

namespace inslab {

template <>
struct EnumNames<navigation::InitialAttitude> {
  static constexpr std::string_view type = "InitialAttitude";
  static constexpr std::string_view prefix = "INITIAL_ATTITUDE_";
  static constexpr std::array<std::string_view, 3> values{"static_alignment", "levelled", "given"};
};

}  // namespace inslab
