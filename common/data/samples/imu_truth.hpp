#pragma once

#include "inslab/data/samples/imu_sample.hpp"

namespace inslab {
inline namespace samples {

/// One triad's error of one interval, term by term; rad for gyros, m/s for accelerometers. Sums to output minus truth.
struct TriadErrorBudget {
  Vector3 bias = Vector3::Zero();
  Vector3 scale = Vector3::Zero();
  Vector3 cross_axis = Vector3::Zero();
  Vector3 g_sensitivity = Vector3::Zero();
  Vector3 vibration = Vector3::Zero();
  Vector3 noise = Vector3::Zero();
  Vector3 limits = Vector3::Zero();
  Vector3 size_effect = Vector3::Zero();  ///< of accelerometers at places of their own
  Vector3 delay = Vector3::Zero();        ///< of a triad that is late
  Vector3 recorded = Vector3::Zero();     ///< of a recording that the profile names
  Vector3 fault = Vector3::Zero();        ///< of the faults that every kind of sensor may have

  Vector3 sum() const {
    return bias + scale + cross_axis + g_sensitivity + vibration + noise + limits + size_effect + delay + recorded +
           fault;
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("bias"), self.bias);
    visit(Field("scale"), self.scale);
    visit(Field("cross_axis"), self.cross_axis);
    visit(Field("g_sensitivity"), self.g_sensitivity);
    visit(Field("vibration"), self.vibration);
    visit(Field("noise"), self.noise);
    visit(Field("limits"), self.limits);
    visit(Field("size_effect").inserted(), self.size_effect);
    visit(Field("delay").inserted(), self.delay);
    visit(Field("recorded").inserted(), self.recorded);
    visit(Field("fault").inserted(), self.fault);
  }
};

/// The perfect IMU beside an ImuSample: same interval, no error, with the true pose of the IMU (idl/imu.idl).
struct ImuTruth {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  Vector3 dtheta_b = Vector3::Zero();  ///< rad
  Vector3 dv_b = Vector3::Zero();      ///< m/s
  std::int64_t interval_ns = 0;
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
  Vector3 v_n = Vector3::Zero();  ///< m/s, the IMU's own velocity in its own NED
  Quaternion q_nb = Quaternion::Identity();
  TriadErrorBudget gyro_error;   ///< rad
  TriadErrorBudget accel_error;  ///< m/s
  bool discontinuity = false;    ///< the IMU was relocated at the start of this interval
  ImuRevisions revisions;
  std::uint32_t active_faults = 0;  ///< those that acted on the sample beside: bits of ActiveFault (common_faults.hpp)

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("dtheta_b_rad"), self.dtheta_b);
    visit(Field("dv_b_m_per_s"), self.dv_b);
    visit(Field("interval_ns"), self.interval_ns);
    visit(Field("latitude_rad"), self.latitude_rad);
    visit(Field("longitude_rad"), self.longitude_rad);
    visit(Field("height_m"), self.height_m);
    visit(Field("v_n_m_per_s"), self.v_n);
    visit(Field("q_nb"), self.q_nb);
    visit(Field("gyro_error_rad"), self.gyro_error);
    visit(Field("accel_error_m_per_s"), self.accel_error);
    visit(Field("discontinuity"), self.discontinuity);
    visit(Field("revisions"), self.revisions);
    visit(Field("active_faults").inserted(), self.active_faults);
  }
};

}  // namespace samples
}  // namespace inslab
