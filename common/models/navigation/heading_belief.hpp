#pragma once

#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab::navigation {

/// What the filter believes of a receiver with two antennas.
struct HeadingBelief {
  FixType fix_type = FixType::Fixed;
  Vector3 baseline_b_m = Vector3::Zero();
  Vector3 relative_sigma_ned_m = Vector3(0.005, 0.005, 0.01);
  Vector3 relative_drift_sigma_ned_m = Vector3(0.005, 0.005, 0.01);
  Vector3 relative_drift_correlation_time_s = Vector3::Constant(100.0);

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("fix_type", "of the solutions that are used; others are not"), self.fix_type);
    visit(Field("baseline_b_m", "from the first antenna to the second, in the IMU's axes; 0: none is used")
              .in(-1000.0, 1000.0),
          self.baseline_b_m);
    visit(Field("relative_sigma_ned_m", "white noise of the second antenna's position relative to the first")
              .in(1e-5, 100.0),
          self.relative_sigma_ned_m);
    visit(Field("relative_drift_sigma_ned_m",
                "states.baseline_drift: of its error that lasts, steady-state and initial standard deviation")
              .in(0.0, 100.0),
          self.relative_drift_sigma_ned_m);
    visit(Field("relative_drift_correlation_time_s", "0: a constant").in(0.0, 1e7),
          self.relative_drift_correlation_time_s);
  }
};

}  // namespace inslab::navigation
