#pragma once

#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// Where a sensor truly sits: topic inslab/profile/installation and the files of config/profiles/installation.
struct InstallationProfile {
  static constexpr ProfileKind kind = ProfileKind::Installation;

  SensorAddress target{SensorKind::Imu, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  Vector3 lever_arm_v_m = Vector3::Zero();         ///< vehicle reference point to IMU centre or antenna phase centre
  Vector3 mounting_rpy_deg = Vector3::Zero();      ///< Z-Y-X roll, pitch, yaw of C_vb; zero for an antenna
  Vector3 second_lever_arm_v_m = Vector3::Zero();  ///< heading: the same of the second antenna; else zero

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("lever_arm_v_m", "from the vehicle's reference point, forward right down").in(-1000.0, 1000.0),
          self.lever_arm_v_m);
    visit(Field("mounting_rpy_deg", "roll, pitch, yaw of the IMU's axes in the vehicle's; zero for an antenna")
              .in(-360.0, 360.0),
          self.mounting_rpy_deg);
    visit(Field("second_lever_arm_v_m",
                "heading: of the second antenna, from the vehicle's reference point; the baseline leads there from the "
                "first")
              .only_for("heading")
              .appended()
              .in(-1000.0, 1000.0),
          self.second_lever_arm_v_m);
  }
};

}  // namespace samples
}  // namespace inslab
