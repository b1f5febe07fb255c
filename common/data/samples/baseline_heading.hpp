#pragma once

#include "inslab/data/samples/gnss_fix.hpp"

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

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("fix_type"), self.fix_type);
    visit(Field("heading_rad"), self.heading_rad);
    visit(Field("pitch_rad"), self.pitch_rad);
    visit(Field("baseline_m"), self.baseline_m);
    visit(Field("heading_sigma_rad"), self.heading_sigma_rad);
    visit(Field("pitch_sigma_rad"), self.pitch_sigma_rad);
    visit(Field("revisions"), self.revisions);
  }
};

}  // namespace samples
}  // namespace inslab
