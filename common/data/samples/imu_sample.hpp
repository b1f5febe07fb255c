#pragma once

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of an IMU sample was made under; 0 is what the scenario began with.
struct ImuRevisions {
  std::uint32_t imu_error = 0;
  std::uint32_t vibration = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("imu_error"), self.imu_error);
    visit(Field("vibration"), self.vibration);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// The output of an IMU over (t - interval, t] (idl/imu.idl).
struct ImuSample {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it: end of the interval and the sensor's latency
  Vector3 dtheta_b = Vector3::Zero();      ///< rad
  Vector3 dv_b = Vector3::Zero();          ///< m/s
  std::int64_t interval_ns = 0;
  Vector3 mean_omega_ib_b = Vector3::Zero();  ///< rad/s, dtheta_b over the interval
  Vector3 mean_f_b = Vector3::Zero();         ///< m/s^2, dv_b over the interval
  double temperature_deg_c = 20.0;
  bool gyro_valid = true;        ///< false: the sensor delivered nothing, the increment is 0
  bool accel_valid = true;       ///< the same
  bool gyro_saturated = false;   ///< an axis was at the end of its scale in this interval
  bool accel_saturated = false;  ///< the same
  ImuRevisions revisions;

  /// The increments follow from the mean rates, where these have been changed.
  void settle(const ImuSample& before) {
    const double dt_s = time::to_seconds(interval_ns);
    if (mean_omega_ib_b != before.mean_omega_ib_b) dtheta_b = dt_s * mean_omega_ib_b;
    if (mean_f_b != before.mean_f_b) dv_b = dt_s * mean_f_b;
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("available_sim_time_ns"), self.available_sim_time_ns);
    visit(Field("dtheta_b_rad"), self.dtheta_b);
    visit(Field("dv_b_m_per_s"), self.dv_b);
    visit(Field("interval_ns"), self.interval_ns);
    visit(Field("mean_omega_ib_b_rad_per_s").measured(-35.0, 35.0), self.mean_omega_ib_b);
    visit(Field("mean_f_b_m_per_s2").measured(-1000.0, 1000.0), self.mean_f_b);
    visit(Field("temperature_deg_c").measured(-40.0, 85.0), self.temperature_deg_c);
    visit(Field("gyro_valid"), self.gyro_valid);
    visit(Field("accel_valid"), self.accel_valid);
    visit(Field("gyro_saturated"), self.gyro_saturated);
    visit(Field("accel_saturated"), self.accel_saturated);
    visit(Field("revisions"), self.revisions);
  }
};

}  // namespace samples
}  // namespace inslab
