#pragma once

#include "inslab/data/profiles/common_faults.hpp"
#include "inslab/data/requests/profile_request.hpp"
#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab {
inline namespace samples {

/// What is wrong with one axis of a sensor: it repeats its last value, shows the wrong sign, or no number at all.
enum class AxisFault : std::uint32_t { None, Stuck, SignFlip, Nan };

template <>
struct EnumNames<AxisFault> {
  static constexpr std::string_view type = "AxisFault";
  static constexpr std::string_view prefix = "AXIS_FAULT_";
  static constexpr std::array<std::string_view, 4> values{"none", "stuck", "sign_flip", "nan"};
};

/// Faults of one sensor, all off by default: topic inslab/profile/fault.
struct FaultProfile {
  static constexpr ProfileKind kind = ProfileKind::Fault;

  SensorAddress target{SensorKind::Imu, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  Vector3 gyro_bias_jump_deg_per_h = Vector3::Zero();              ///< imu
  Vector3 accel_bias_jump_mgal = Vector3::Zero();                  ///< imu
  Vector3 gyro_noise_burst_deg_per_sqrt_h = Vector3::Zero();       ///< imu
  Vector3 accel_noise_burst_m_per_s_per_sqrt_h = Vector3::Zero();  ///< imu
  std::array<AxisFault, 3> gyro_axes{};                            ///< imu
  std::array<AxisFault, 3> accel_axes{};                           ///< imu
  bool gyro_silent = false;                                        ///< imu: no rates while on
  bool accel_silent = false;                                       ///< imu: no specific forces while on
  Vector3 position_jump_ned_m = Vector3::Zero();                   ///< gnss
  Vector3 velocity_jump_ned_m_per_s = Vector3::Zero();             ///< gnss
  Vector3 position_drift_ned_m_per_s = Vector3::Zero();            ///< gnss: spoofing that leads away slowly
  bool drift_in_velocity = false;                                  ///< gnss
  bool outage = false;                                             ///< gnss: no fixes while on
  Vector3 magnetic_jump_nt = Vector3::Zero();                      ///< magnetometer
  Vector3 magnetic_noise_burst_nt = Vector3::Zero();               ///< magnetometer
  std::array<AxisFault, 3> magnetometer_axes{};                    ///< magnetometer
  bool magnetometer_silent = false;                                ///< magnetometer: no samples while on
  double pressure_jump_pa = 0.0;                                   ///< barometer
  double pressure_noise_burst_pa = 0.0;                            ///< barometer
  AxisFault barometer_fault = AxisFault::None;                     ///< barometer
  bool barometer_silent = false;                                   ///< barometer: no samples while on
  double wheel_speed_jump_m_per_s = 0.0;                           ///< odometer
  double wheel_speed_noise_burst_m_per_s = 0.0;                    ///< odometer
  AxisFault odometer_fault = AxisFault::None;                      ///< odometer
  bool wheel_locked = false;                                       ///< odometer: the wheel does not turn
  bool odometer_silent = false;                                    ///< odometer: no samples while on
  FixType wrong_fix_type = FixType::None;                ///< gnss: what fixes claim to be; none: what they are
  Vector3 position_noise_burst_ned_m = Vector3::Zero();  ///< gnss
  CommonFaults common;                                   ///< every kind
  Vector3 wrong_fix_ned_m = Vector3::Zero();             ///< heading
  bool heading_outage = false;                           ///< heading: no signals while on
  bool pitot_blocked = false;                            ///< air_data
  bool pitot_drain_blocked = false;                      ///< air_data
  bool static_port_blocked = false;                      ///< air_data
  bool vanes_frozen = false;                             ///< air_data

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "why").at_most(256), self.source);
    visit(Field("gyro_bias_jump_deg_per_h", "imu: bias added while the fault is on").only_for("imu").in(-1e6, 1e6),
          self.gyro_bias_jump_deg_per_h);
    visit(Field("accel_bias_jump_mgal", "imu: bias added while the fault is on").only_for("imu").in(-1e7, 1e7),
          self.accel_bias_jump_mgal);
    visit(Field("gyro_noise_burst_deg_per_sqrt_h", "imu: white noise added while the fault is on")
              .only_for("imu")
              .in(0.0, 1e5),
          self.gyro_noise_burst_deg_per_sqrt_h);
    visit(Field("accel_noise_burst_m_per_s_per_sqrt_h", "imu: white noise added while the fault is on")
              .only_for("imu")
              .in(0.0, 1e5),
          self.accel_noise_burst_m_per_s_per_sqrt_h);
    visit(Field("gyro_fault_x", "imu: what is wrong with the axis").only_for("imu"), self.gyro_axes[0]);
    visit(Field("gyro_fault_y", "imu: what is wrong with the axis").only_for("imu"), self.gyro_axes[1]);
    visit(Field("gyro_fault_z", "imu: what is wrong with the axis").only_for("imu"), self.gyro_axes[2]);
    visit(Field("accel_fault_x", "imu: what is wrong with the axis").only_for("imu"), self.accel_axes[0]);
    visit(Field("accel_fault_y", "imu: what is wrong with the axis").only_for("imu"), self.accel_axes[1]);
    visit(Field("accel_fault_z", "imu: what is wrong with the axis").only_for("imu"), self.accel_axes[2]);
    visit(Field("gyro_silent", "imu: no rates while on").only_for("imu"), self.gyro_silent);
    visit(Field("accel_silent", "imu: no specific forces while on").only_for("imu"), self.accel_silent);
    visit(Field("position_jump_ned_m", "gnss: offset added while the fault is on").only_for("gnss").in(-1e5, 1e5),
          self.position_jump_ned_m);
    visit(Field("velocity_jump_ned_m_per_s", "gnss: offset added while the fault is on").only_for("gnss").in(-1e4, 1e4),
          self.velocity_jump_ned_m_per_s);
    visit(Field("position_drift_ned_m_per_s",
                "gnss: speed of an offset that grows from 0 when the fault comes on, to at most 100 km")
              .only_for("gnss")
              .in(-1e3, 1e3),
          self.position_drift_ned_m_per_s);
    visit(Field("drift_in_velocity", "gnss: velocity shows the drift too, as a consistent spoofer makes it")
              .only_for("gnss"),
          self.drift_in_velocity);
    visit(Field("outage", "gnss: no fix while on").only_for("gnss"), self.outage);
    visit(Field("magnetic_jump_nt", "magnetometer: field added while the fault is on")
              .only_for("magnetometer")
              .appended()
              .in(-1e6, 1e6),
          self.magnetic_jump_nt);
    visit(Field("magnetic_noise_burst_nt", "magnetometer: white noise added while the fault is on, of one sample")
              .only_for("magnetometer")
              .appended()
              .in(0.0, 1e6),
          self.magnetic_noise_burst_nt);
    visit(
        Field("magnetometer_fault_x", "magnetometer: what is wrong with the axis").only_for("magnetometer").appended(),
        self.magnetometer_axes[0]);
    visit(
        Field("magnetometer_fault_y", "magnetometer: what is wrong with the axis").only_for("magnetometer").appended(),
        self.magnetometer_axes[1]);
    visit(
        Field("magnetometer_fault_z", "magnetometer: what is wrong with the axis").only_for("magnetometer").appended(),
        self.magnetometer_axes[2]);
    visit(Field("magnetometer_silent", "magnetometer: no sample while on").only_for("magnetometer").appended(),
          self.magnetometer_silent);
    visit(Field("pressure_jump_pa", "barometer: pressure added while the fault is on")
              .only_for("barometer")
              .appended()
              .in(-1e5, 1e5),
          self.pressure_jump_pa);
    visit(Field("pressure_noise_burst_pa", "barometer: white noise added while the fault is on, of one sample")
              .only_for("barometer")
              .appended()
              .in(0.0, 1e5),
          self.pressure_noise_burst_pa);
    visit(Field("barometer_fault", "barometer: what is wrong with the pressure; stuck is a port that is blocked")
              .only_for("barometer")
              .appended(),
          self.barometer_fault);
    visit(Field("barometer_silent", "barometer: no sample while on").only_for("barometer").appended(),
          self.barometer_silent);
    visit(Field("wheel_speed_jump_m_per_s", "odometer: speed added while the fault is on")
              .only_for("odometer")
              .appended()
              .in(-1e3, 1e3),
          self.wheel_speed_jump_m_per_s);
    visit(Field("wheel_speed_noise_burst_m_per_s", "odometer: white noise added while the fault is on, of one sample")
              .only_for("odometer")
              .appended()
              .in(0.0, 1e3),
          self.wheel_speed_noise_burst_m_per_s);
    visit(Field("odometer_fault", "odometer: what is wrong with the distance").only_for("odometer").appended(),
          self.odometer_fault);
    visit(Field("wheel_locked", "odometer: the wheel does not turn while on").only_for("odometer").appended(),
          self.wheel_locked);
    visit(Field("odometer_silent", "odometer: no sample while on").only_for("odometer").appended(),
          self.odometer_silent);
    visit(Field("wrong_fix_type", "gnss: what fixes claim to be while on; none: what they are")
              .only_for("gnss")
              .appended(),
          self.wrong_fix_type);
    visit(Field("position_noise_burst_ned_m", "gnss: white noise added while the fault is on, of one fix")
              .only_for("gnss")
              .appended()
              .in(0.0, 1e5),
          self.position_noise_burst_ned_m);
    CommonFaults::fields(self.common, visit);
    visit(Field("wrong_fix_ned_m", "heading: by so much the second antenna is taken to be elsewhere while on")
              .only_for("heading")
              .appended()
              .in(-100.0, 100.0),
          self.wrong_fix_ned_m);
    visit(Field("heading_outage", "heading: no signals while on; then it climbs its ladder")
              .only_for("heading")
              .appended(),
          self.heading_outage);
    visit(
        Field("pitot_blocked",
              "air_data: ice in the tube's mouth; through the open drain its line empties, and the airspeed falls to 0")
            .only_for("air_data")
            .appended(),
        self.pitot_blocked);
    visit(Field("pitot_drain_blocked",
                "air_data: ice in the tube's drain; with the mouth blocked too its line keeps its pressure, and the "
                "airspeed grows and falls with the height")
              .only_for("air_data")
              .appended(),
          self.pitot_drain_blocked);
    visit(Field("static_port_blocked", "air_data: the static line keeps its pressure").only_for("air_data").appended(),
          self.static_port_blocked);
    visit(Field("vanes_frozen", "air_data: both vanes keep their angle").only_for("air_data").appended(),
          self.vanes_frozen);
  }
};

}  // namespace samples
}  // namespace inslab
