#pragma once

#include "inslab/data/samples/stream_header.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of a sample was made under; 0 is what the scenario began with.
struct MagnetometerRevisions {
  std::uint32_t magnetometer_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("magnetometer_error"), self.magnetometer_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// What a magnetometer of three axes puts out (idl/magnetometer.idl).
struct MagneticField {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  Vector3 B_b_nt = Vector3::Zero();  ///< along the sensor's axes
  bool saturated = false;            ///< an axis was at the end of its range
  MagnetometerRevisions revisions;
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("B_b_nt").measured(-200000.0, 200000.0), self.B_b_nt);
    visit(Field("saturated"), self.saturated);
    visit(Field("revisions"), self.revisions);
    visit(Field("available_sim_time_ns").appended(), self.available_sim_time_ns);
  }
};

}  // namespace samples
}  // namespace inslab
