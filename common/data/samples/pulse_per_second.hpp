#pragma once

#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab {
inline namespace samples {

/// A pulse of a receiver, one a whole second of GPS time (idl/gnss.idl). Its edge is at header.sim_time_ns, rounded to
/// a nanosecond, and header.gps_week and gps_time_of_week_ns are the second that the receiver says it marks.
struct PulsePerSecond {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  double quantization_error_ns = 0.0;  ///< as the receiver knows it: so much later than meant, for want of a tick
  bool in_holdover = false;            ///< the receiver had no fix
  GnssRevisions revisions;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("quantization_error_ns"), self.quantization_error_ns);
    visit(Field("in_holdover"), self.in_holdover);
    visit(Field("revisions"), self.revisions);
  }
};

/// The second beside a PulsePerSecond, and its error budget (idl/gnss.idl). header.sim_time_ns is the whole second.
struct PulseTruth {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  double offset_ns = 0.0;
  double jitter_ns = 0.0;
  double holdover_ns = 0.0;
  double quantization_ns = 0.0;
  GnssRevisions revisions;

  /// Rise less the second.
  double error_ns() const { return offset_ns + jitter_ns + holdover_ns + quantization_ns; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("offset_ns"), self.offset_ns);
    visit(Field("jitter_ns"), self.jitter_ns);
    visit(Field("holdover_ns"), self.holdover_ns);
    visit(Field("quantization_ns"), self.quantization_ns);
    visit(Field("revisions"), self.revisions);
  }
};

}  // namespace samples
}  // namespace inslab
