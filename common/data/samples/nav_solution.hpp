#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

enum class ReferencePoint : std::uint32_t { Imu, Vehicle, Antenna };
enum class NavMode : std::uint32_t { Initializing, Aligning, Navigating, Coasting, Fault };

template <>
struct EnumNames<ReferencePoint> {
  static constexpr std::string_view type = "ReferencePoint";
  static constexpr std::string_view prefix = "REFERENCE_";
  static constexpr std::array<std::string_view, 3> values{"imu", "vehicle", "antenna"};
};
template <>
struct EnumNames<NavMode> {
  static constexpr std::string_view type = "NavMode";
  static constexpr std::string_view prefix = "NAV_MODE_";
  static constexpr std::array<std::string_view, 5> values{"initializing", "aligning", "navigating", "coasting",
                                                          "fault"};
};

/// The answer of the navigation app under test (idl/nav.idl).
struct NavSolution {
  std::uint32_t gps_week = 0;
  std::int64_t gps_time_of_week_ns = 0;
  std::uint64_t imu_sequence = 0;  ///< the newest IMU sample that went into it
  ReferencePoint reference_point = ReferencePoint::Imu;
  NavMode mode = NavMode::Initializing;
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
  Vector3 v_n = Vector3::Zero();                 ///< m/s
  Quaternion q_n_body = Quaternion::Identity();  ///< q_nb for the IMU, q_nv for vehicle and antenna
  Vector3 position_sigma_ned_m = Vector3::Zero();
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();
  Vector3 attitude_sigma_rad = Vector3::Zero();  ///< about north, east, down

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("gps_week"), self.gps_week);
    visit(Field("gps_time_of_week_ns"), self.gps_time_of_week_ns);
    visit(Field("imu_sequence"), self.imu_sequence);
    visit(Field("reference_point"), self.reference_point);
    visit(Field("mode"), self.mode);
    visit(Field("latitude_rad"), self.latitude_rad);
    visit(Field("longitude_rad"), self.longitude_rad);
    visit(Field("height_m"), self.height_m);
    visit(Field("v_n_m_per_s"), self.v_n);
    visit(Field("q_n_body"), self.q_n_body);
    visit(Field("position_sigma_ned_m"), self.position_sigma_ned_m);
    visit(Field("velocity_sigma_ned_m_per_s"), self.velocity_sigma_ned_m_per_s);
    visit(Field("attitude_sigma_rad"), self.attitude_sigma_rad);
  }
};

}  // namespace samples
}  // namespace inslab
