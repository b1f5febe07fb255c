#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::navigation {

/// What the filter believes of a barometer and of the air about it. The bias of its pressure altitude is the sum of
/// three errors, each Gauss-Markov with a correlation time of 0 for a constant: were they one, the large constant would
/// drift as fast as the small rest does.
struct BarometerBelief {
  Vector3 lever_arm_b_m = Vector3::Zero();
  double lag_s = 0.0;
  double white_sigma_pa = 3.0;
  Vector3 bias_sigma_m = Vector3(100.0, 5.0, 1.0);
  Vector3 bias_correlation_time_s = Vector3(0.0, 7200.0, 1800.0);
  double height_scale_sigma = 0.03;
  double static_pressure_sigma = 0.1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("lever_arm_b_m", "from the IMU's centre to the port, in the IMU's axes").in(-1000.0, 1000.0),
          self.lever_arm_b_m);
    visit(Field("lag_s", "of port and filter, short beside the vehicle's climbs").in(0.0, 100.0), self.lag_s);
    visit(Field("white_sigma_pa", "white noise of one sample").in(1e-3, 1e4), self.white_sigma_pa);
    visit(Field("bias_sigma_m",
                "states.pressure_bias: constant (geoid, pressure at sea level), drift of the weather, drift of the "
                "sensor: steady-state and initial standard deviations")
              .in(0.0, 1e5),
          self.bias_sigma_m);
    visit(Field("bias_correlation_time_s", "of each; 0: a constant").in(0.0, 1e7), self.bias_correlation_time_s);
    visit(Field("height_scale_sigma",
                "states.pressure_slope: of heights, by air warmer or colder than the standard's; a constant")
              .in(0.0, 1.0),
          self.height_scale_sigma);
    visit(Field("static_pressure_sigma",
                "states.pressure_slope: of the dynamic pressure that the port shows too much; a constant")
              .in(0.0, 2.0),
          self.static_pressure_sigma);
  }
};

}  // namespace inslab::navigation
