#pragma once

#include "samples/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// Faults of one sensor, all off by default: topic inslab/profile/fault.
struct FaultProfile {
  static constexpr ProfileKind kind = ProfileKind::Fault;

  SensorAddress target{SensorKind::Imu, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  Vector3 gyro_bias_jump_deg_per_h = Vector3::Zero();  ///< imu
  Vector3 accel_bias_jump_mgal = Vector3::Zero();      ///< imu
  Vector3 position_jump_ned_m = Vector3::Zero();       ///< gnss
  bool outage = false;                                 ///< gnss: no fixes while on

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "why").at_most(256), self.source);
    visit(Field("gyro_bias_jump_deg_per_h", "imu: bias added while the fault is on").in(-1e6, 1e6),
          self.gyro_bias_jump_deg_per_h);
    visit(Field("accel_bias_jump_mgal", "imu: bias added while the fault is on").in(-1e7, 1e7),
          self.accel_bias_jump_mgal);
    visit(Field("position_jump_ned_m", "gnss: offset added while the fault is on").in(-1e5, 1e5),
          self.position_jump_ned_m);
    visit(Field("outage", "gnss: no fix while on"), self.outage);
  }
};

}  // namespace samples
}  // namespace inslab
