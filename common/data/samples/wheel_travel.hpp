#pragma once

#include "inslab/data/samples/stream_header.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of a sample was made under; 0 is what the scenario began with.
struct OdometerRevisions {
  std::uint32_t odometer_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("odometer_error"), self.odometer_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// What an odometer on one wheel puts out (idl/odometer.idl).
struct WheelTravel {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  std::int64_t interval_ns = 0;  ///< the sample is of the interval that ends at header.sim_time_ns
  double distance_m = 0.0;       ///< rolled in it; below 0 backwards where the direction is known
  double speed_m_per_s = 0.0;    ///< the mean of the interval
  std::int64_t counts = 0;       ///< of the encoder in it; 0 where it has none
  bool direction_known = true;
  OdometerRevisions revisions;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("interval_ns"), self.interval_ns);
    visit(Field("distance_m"), self.distance_m);
    visit(Field("speed_m_per_s"), self.speed_m_per_s);
    visit(Field("counts"), self.counts);
    visit(Field("direction_known"), self.direction_known);
    visit(Field("revisions"), self.revisions);
  }
};

}  // namespace samples
}  // namespace inslab
