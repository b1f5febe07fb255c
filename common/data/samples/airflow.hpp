#pragma once

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/compressible_flow.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of a sample was made under; 0 is what the scenario began with.
struct AirDataRevisions {
  std::uint32_t air_data_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("air_data_error"), self.air_data_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// What an air data probe with its vanes puts out (idl/air_data.idl): what it measures, and what its computer makes of
/// that by the standard atmosphere and the laws of compressible flow.
struct Airflow {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  double impact_pressure_pa = 0.0;       ///< of the pitot line less that of the static line
  double static_pressure_pa = 0.0;       ///< of the static line
  double total_temperature_deg_c = 0.0;  ///< of the probe in the flow
  double angle_of_attack_rad = 0.0;      ///< of the flow against the probe's axes: atan2(w, u)
  double angle_of_sideslip_rad = 0.0;    ///< asin(v/V): flow from the right is positive
  double mach = 0.0;                     ///< and these follow from the pressures and the temperature
  double true_airspeed_m_per_s = 0.0;
  double calibrated_airspeed_m_per_s = 0.0;  ///< what an airspeed indicator shows
  double pressure_altitude_m = 0.0;
  bool saturated = false;  ///< a pressure or an angle was at an end of its range
  AirDataRevisions revisions;
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it

  /// What follows from the measured values.
  void settle(const Airflow&) { compute(); }
  void compute() {
    namespace flow = nav::compressible_flow;
    mach = flow::mach_of(impact_pressure_pa / static_pressure_pa);
    true_airspeed_m_per_s =
        flow::true_airspeed_m_per_s(mach, total_temperature_deg_c + nav::standard_atmosphere::kZeroCelsiusK);
    calibrated_airspeed_m_per_s = flow::calibrated_airspeed_m_per_s(impact_pressure_pa);
    pressure_altitude_m = nav::standard_atmosphere::pressure_altitude_m(static_pressure_pa);
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    constexpr double kEighthTurn = 0.25 * units::kPi;
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("impact_pressure_pa").measured(-7000.0, 100000.0), self.impact_pressure_pa);
    visit(Field("static_pressure_pa").measured(1000.0, 120000.0), self.static_pressure_pa);
    visit(Field("total_temperature_deg_c").measured(-90.0, 200.0), self.total_temperature_deg_c);
    visit(Field("angle_of_attack_rad").measured(-kEighthTurn, kEighthTurn), self.angle_of_attack_rad);
    visit(Field("angle_of_sideslip_rad").measured(-kEighthTurn, kEighthTurn), self.angle_of_sideslip_rad);
    visit(Field("mach"), self.mach);
    visit(Field("true_airspeed_m_per_s"), self.true_airspeed_m_per_s);
    visit(Field("calibrated_airspeed_m_per_s"), self.calibrated_airspeed_m_per_s);
    visit(Field("pressure_altitude_m"), self.pressure_altitude_m);
    visit(Field("saturated"), self.saturated);
    visit(Field("revisions"), self.revisions);
    visit(Field("available_sim_time_ns"), self.available_sim_time_ns);
  }
};

}  // namespace samples
}  // namespace inslab
