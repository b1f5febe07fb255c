#pragma once

#include "inslab/data/samples/airflow.hpp"

namespace inslab {
inline namespace samples {

/// The error of one pressure of an Airflow, term by term, Pa. Sums to what is shown minus the truth.
struct PressureErrorBudget {
  double probe = 0.0;       ///< flow beyond the angle that the tube accepts
  double position = 0.0;    ///< static pressure error of the port's place
  double line = 0.0;        ///< lag of the lines, and what blocks them
  double instrument = 0.0;  ///< scale factor and offset
  double noise = 0.0;
  double limits = 0.0;  ///< range and counts
  double fault = 0.0;   ///< of the faults that every kind of sensor may have

  double sum() const { return probe + position + line + instrument + noise + limits + fault; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("probe"), self.probe);
    visit(Field("position"), self.position);
    visit(Field("line"), self.line);
    visit(Field("instrument"), self.instrument);
    visit(Field("noise"), self.noise);
    visit(Field("limits"), self.limits);
    visit(Field("fault"), self.fault);
  }
};

/// The same of one angle of it, rad.
struct FlowAngleErrorBudget {
  double vane = 0.0;  ///< upwash, scale factor, bias, and a vane that is frozen
  double noise = 0.0;
  double limits = 0.0;  ///< range and counts
  double fault = 0.0;   ///< of the faults that every kind of sensor may have

  double sum() const { return vane + noise + limits + fault; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("vane"), self.vane);
    visit(Field("noise"), self.noise);
    visit(Field("limits"), self.limits);
    visit(Field("fault"), self.fault);
  }
};

/// The air at the probe beside an Airflow: what a perfect probe would show, the wind, and the error budgets
/// (idl/air_data.idl).
struct AirflowTruth {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  Vector3 wind_ned_m_per_s = Vector3::Zero();  ///< where the air moves to, gusts included
  Vector3 gust_ned_m_per_s = Vector3::Zero();  ///< the part of it that is turbulence
  double true_airspeed_m_per_s = 0.0;
  double impact_pressure_pa = 0.0;
  double static_pressure_pa = 0.0;
  double static_temperature_deg_c = 0.0;
  double angle_of_attack_rad = 0.0;
  double angle_of_sideslip_rad = 0.0;
  PressureErrorBudget impact_pressure_error;     ///< Pa
  PressureErrorBudget static_pressure_error;     ///< Pa
  FlowAngleErrorBudget angle_of_attack_error;    ///< rad
  FlowAngleErrorBudget angle_of_sideslip_error;  ///< rad
  AirDataRevisions revisions;
  std::uint32_t active_faults = 0;  ///< those that acted on the sample beside: bits of ActiveFault (common_faults.hpp)

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("wind_ned_m_per_s"), self.wind_ned_m_per_s);
    visit(Field("gust_ned_m_per_s"), self.gust_ned_m_per_s);
    visit(Field("true_airspeed_m_per_s"), self.true_airspeed_m_per_s);
    visit(Field("impact_pressure_pa"), self.impact_pressure_pa);
    visit(Field("static_pressure_pa"), self.static_pressure_pa);
    visit(Field("static_temperature_deg_c"), self.static_temperature_deg_c);
    visit(Field("angle_of_attack_rad"), self.angle_of_attack_rad);
    visit(Field("angle_of_sideslip_rad"), self.angle_of_sideslip_rad);
    visit(Field("impact_pressure_error_pa"), self.impact_pressure_error);
    visit(Field("static_pressure_error_pa"), self.static_pressure_error);
    visit(Field("angle_of_attack_error_rad"), self.angle_of_attack_error);
    visit(Field("angle_of_sideslip_error_rad"), self.angle_of_sideslip_error);
    visit(Field("revisions"), self.revisions);
    visit(Field("active_faults"), self.active_faults);
  }
};

}  // namespace samples
}  // namespace inslab
