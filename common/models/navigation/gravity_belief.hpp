#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::navigation {

/// What the filter believes of gravity's departure from its model (nav/gravity_along_way.hpp). By itself: hills with
/// deflections of 6 seconds of arc.
struct GravityBelief {
  Vector3 sigma_ned_mgal = Vector3(28.5, 28.5, 40.3);
  double correlation_m = 14142.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("sigma_ned_mgal",
                "states.gravity_disturbance: steady-state and initial standard deviation of what is added to gravity; "
                "4.75 mGal to the north or east are a second of arc of the plumb line")
              .in(0.0, 1e4),
          self.sigma_ned_mgal);
    visit(Field("correlation_m",
                "D of the correlation (1 + s/D) exp(-s/D) over the distance s along the ground; 0: a constant")
              .in(0.0, 1e7),
          self.correlation_m);
  }
};

}  // namespace inslab::navigation
