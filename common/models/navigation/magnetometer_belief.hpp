#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::navigation {

/// What the filter believes of a magnetometer, and of the model of the Earth's field that it compares it with. Errors
/// that are estimated are Gauss-Markov; a correlation time of 0 stands for a constant.
struct MagnetometerBelief {
  Vector3 mounting_rpy_deg = Vector3::Zero();
  Vector3 white_sigma_nt = Vector3::Constant(100.0);
  Vector3 hard_iron_sigma_nt = Vector3::Constant(500.0);
  Vector3 hard_iron_correlation_time_s = Vector3::Zero();
  Vector9 soft_iron_sigma = Vector9::Constant(0.005);
  Vector3 earth_field_sigma_ned_nt = Vector3(137.0, 89.0, 141.0);
  Vector3 earth_field_correlation_time_s = Vector3::Constant(600.0);

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("mounting_rpy_deg", "roll, pitch, yaw of the magnetometer in the IMU's axes").in(-360.0, 360.0),
          self.mounting_rpy_deg);
    visit(Field("white_sigma_nt", "white noise of one sample").in(1e-3, 1e6), self.white_sigma_nt);
    visit(Field("hard_iron_sigma_nt", "states.hard_iron: steady-state and initial standard deviation").in(0.0, 1e6),
          self.hard_iron_sigma_nt);
    visit(Field("hard_iron_correlation_time_s", "0: a constant").in(0.0, 1e7), self.hard_iron_correlation_time_s);
    visit(Field("soft_iron_sigma", "states.soft_iron: standard deviation of each element, row by row; constants")
              .in(0.0, 1.0),
          self.soft_iron_sigma);
    visit(Field("earth_field_sigma_ned_nt",
                "states.earth_field: what the World Magnetic Model leaves out; by default its own estimate")
              .in(0.0, 1e6),
          self.earth_field_sigma_ned_nt);
    visit(Field("earth_field_correlation_time_s", "how long the vehicle stays in it; 0: a constant").in(0.0, 1e7),
          self.earth_field_correlation_time_s);
  }
};

}  // namespace inslab::navigation
