#pragma once

#include "samples/profile_request.hpp"

namespace inslab {
inline namespace samples {

enum class VibrationDomain : std::uint32_t { Sensor };

template <>
struct EnumNames<VibrationDomain> {
  static constexpr std::string_view type = "VibrationDomain";
  static constexpr std::string_view prefix = "VIBRATION_";
  static constexpr std::array<std::string_view, 1> values{"sensor"};
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

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("domain", "sensor: added to the IMU's output alone"), self.domain);
    visit(Field("linear", "sinusoids of specific force").at_most(16), self.linear);
    visit(Field("angular", "sinusoids of angular rate").at_most(16), self.angular);
  }
};

}  // namespace samples
}  // namespace inslab
