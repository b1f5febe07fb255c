#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// What every stream sample begins with: who sent which sample of which run, and when.
struct StreamHeader {
  RunId run_id;
  std::uint64_t sequence_number = 0;  ///< one count per stream, from 0, without gaps
  std::int64_t sim_time_ns = 0;       ///< since the scenario's start; time of validity
  std::uint32_t gps_week = 0;         ///< full, no rollover: the sensor's tag, by its own clock
  std::int64_t gps_time_of_week_ns = 0;
  std::int64_t publish_realtime_ns = 0;   ///< CLOCK_REALTIME of the sending host; 0 when not sent
  std::int64_t publish_monotonic_ns = 0;  ///< CLOCK_MONOTONIC of the sending host; 0 when not sent
  bool published_late = false;            ///< an overrun: the truth went out more than a period after its deadline

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("sequence_number"), self.sequence_number);
    visit(Field("sim_time_ns"), self.sim_time_ns);
    visit(Field("gps_week"), self.gps_week);
    visit(Field("gps_time_of_week_ns"), self.gps_time_of_week_ns);
    visit(Field("publish_realtime_ns"), self.publish_realtime_ns);
    visit(Field("publish_monotonic_ns"), self.publish_monotonic_ns);
    visit(Field("published_late"), self.published_late);
  }
};

}  // namespace samples
}  // namespace inslab
