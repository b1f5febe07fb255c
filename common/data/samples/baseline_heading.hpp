#pragma once

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab {
inline namespace samples {

/// Which journal entry each part of a sample was made under; 0 is what the scenario began with.
struct HeadingRevisions {
  std::uint32_t heading_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("heading_error"), self.heading_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// What a receiver with two antennas says of the vector from the first to the second (idl/heading.idl).
struct BaselineHeading {
  StreamHeader header;
  std::uint32_t sensor_number = 0;
  FixType fix_type = FixType::None;  ///< of the vector
  double heading_rad = 0.0;          ///< of the second antenna as seen from the first, from north, 0 to 2 pi
  double pitch_rad = 0.0;            ///< of the vector over the horizon
  double baseline_m = 0.0;           ///< its length, as measured
  double heading_sigma_rad = 0.0;    ///< as the receiver claims
  double pitch_sigma_rad = 0.0;      ///< the same
  HeadingRevisions revisions;
  std::int64_t available_sim_time_ns = 0;  ///< when an app has it

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    constexpr double kQuarterTurn = 0.5 * units::kPi;
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("fix_type"), self.fix_type);
    visit(Field("heading_rad").measured(0.0, 4.0 * kQuarterTurn), self.heading_rad);
    visit(Field("pitch_rad").measured(-kQuarterTurn, kQuarterTurn), self.pitch_rad);
    visit(Field("baseline_m").measured(0.0, 100.0), self.baseline_m);
    visit(Field("heading_sigma_rad"), self.heading_sigma_rad);
    visit(Field("pitch_sigma_rad"), self.pitch_sigma_rad);
    visit(Field("revisions"), self.revisions);
    visit(Field("available_sim_time_ns").appended(), self.available_sim_time_ns);
  }
};

}  // namespace samples
}  // namespace inslab
