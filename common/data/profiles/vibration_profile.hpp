#pragma once

#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

enum class VibrationDomain : std::uint32_t { Sensor, Motion };

template <>
struct EnumNames<VibrationDomain> {
  static constexpr std::string_view type = "VibrationDomain";
  static constexpr std::string_view prefix = "VIBRATION_";
  static constexpr std::array<std::string_view, 2> values{"sensor", "motion"};
};

/// amplitude * sin(2 pi f t + phase) of specific force, along the b axes.
struct LinearSinusoid {
  Vector3 amplitude_m_per_s2 = Vector3::Zero();
  double frequency_hz = 0.0;
  Vector3 phase_deg = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("amplitude_m_per_s2", "peak").in(-1e3, 1e3).required(), self.amplitude_m_per_s2);
    visit(Field("frequency_hz", "may lie above half the sample rate").in(1e-3, 1e5).required(), self.frequency_hz);
    visit(Field("phase_deg", "at the start of the scenario").in(-360.0, 360.0), self.phase_deg);
  }
};

/// amplitude * sin(2 pi f t + phase) of angular rate, about the b axes.
struct AngularSinusoid {
  Vector3 amplitude_deg_per_s = Vector3::Zero();
  double frequency_hz = 0.0;
  Vector3 phase_deg = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("amplitude_deg_per_s", "peak").in(-1e4, 1e4).required(), self.amplitude_deg_per_s);
    visit(Field("frequency_hz", "may lie above half the sample rate").in(1e-3, 1e5).required(), self.frequency_hz);
    visit(Field("phase_deg", "at the start of the scenario").in(-360.0, 360.0), self.phase_deg);
  }
};

/// A corner of the power spectral density of random specific force along the b axes. Between two corners it is a
/// straight line of logarithms (of the densities themselves where one is 0), outside the table it is 0.
struct LinearRandomPoint {
  double frequency_hz = 0.0;
  Vector3 density_m2_per_s3 = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("frequency_hz", "may lie above half the sample rate").in(1e-3, 1e4).required(), self.frequency_hz);
    visit(Field("density_m2_per_s3", "(m/s^2)^2/Hz, one-sided").in(0.0, 1e6).required(), self.density_m2_per_s3);
  }
};

/// The same of random angular rate about the b axes.
struct AngularRandomPoint {
  double frequency_hz = 0.0;
  Vector3 density_deg2_per_s = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("frequency_hz", "may lie above half the sample rate").in(1e-3, 1e4).required(), self.frequency_hz);
    visit(Field("density_deg2_per_s", "(deg/s)^2/Hz, one-sided").in(0.0, 1e8).required(), self.density_deg2_per_s);
  }
};

/// What shakes one IMU: topic inslab/profile/vibration and the files of config/profiles/vibration.
struct VibrationProfile {
  static constexpr ProfileKind kind = ProfileKind::Vibration;

  SensorAddress target{SensorKind::Imu, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  VibrationDomain domain = VibrationDomain::Sensor;
  std::vector<LinearSinusoid> linear;
  std::vector<AngularSinusoid> angular;
  std::vector<LinearRandomPoint> linear_random;
  std::vector<AngularRandomPoint> angular_random;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("domain", "sensor: added to the IMU's output alone; motion: the mount moves, at most 5 cm and 2 deg"),
          self.domain);
    visit(Field("linear", "sinusoids of specific force").at_most(16), self.linear);
    visit(Field("angular", "sinusoids of angular rate").at_most(16), self.angular);
    visit(Field("linear_random", "random specific force: power spectral density by frequency").at_most(32),
          self.linear_random);
    visit(Field("angular_random", "random angular rate: power spectral density by frequency").at_most(32),
          self.angular_random);
  }
};

}  // namespace samples
}  // namespace inslab
