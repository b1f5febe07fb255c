#pragma once

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/nav/standard_atmosphere.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of a sample was made under; 0 is what the scenario began with.
struct BarometerRevisions {
  std::uint32_t barometer_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("barometer_error"), self.barometer_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// What a barometer puts out (idl/barometer.idl).
struct AirPressure {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  double pressure_pa = 0.0;
  double temperature_deg_c = 0.0;    ///< of the sensor
  double pressure_altitude_m = 0.0;  ///< geopotential height of the pressure in the standard atmosphere
  bool saturated = false;            ///< the pressure was at an end of its range
  BarometerRevisions revisions;
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it

  /// The pressure altitude follows from the pressure.
  void settle(const AirPressure& before) {
    if (pressure_pa != before.pressure_pa)
      pressure_altitude_m = nav::standard_atmosphere::pressure_altitude_m(pressure_pa);
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("pressure_pa").measured(30000.0, 110000.0), self.pressure_pa);
    visit(Field("temperature_deg_c").measured(-40.0, 85.0), self.temperature_deg_c);
    visit(Field("pressure_altitude_m"), self.pressure_altitude_m);
    visit(Field("saturated"), self.saturated);
    visit(Field("revisions"), self.revisions);
    visit(Field("available_sim_time_ns").appended(), self.available_sim_time_ns);
  }
};

}  // namespace samples
}  // namespace inslab
