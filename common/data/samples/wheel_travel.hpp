#pragma once

#include <cmath>

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/time/gps_time.hpp"

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
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it

  /// The distance follows from the speed, and counts from the distance: those of a wheel that showed some, whose counts
  /// say how long one is.
  void settle(const WheelTravel& before) {
    if (speed_m_per_s == before.speed_m_per_s) return;
    distance_m = speed_m_per_s * time::to_seconds(interval_ns);
    if (before.counts == 0) return;
    const double counts_now = distance_m / before.distance_m * static_cast<double>(before.counts);
    counts = std::isfinite(counts_now) ? std::llround(counts_now) : 0;
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("interval_ns"), self.interval_ns);
    visit(Field("distance_m"), self.distance_m);
    visit(Field("speed_m_per_s").measured(-100.0, 100.0), self.speed_m_per_s);
    visit(Field("counts"), self.counts);
    visit(Field("direction_known"), self.direction_known);
    visit(Field("revisions"), self.revisions);
    visit(Field("available_sim_time_ns").appended(), self.available_sim_time_ns);
  }
};

}  // namespace samples
}  // namespace inslab
