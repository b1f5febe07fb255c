#pragma once

#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// A step of a sensor's clock that stays.
struct TimeTagStep {
  double at_s = 0.0;
  double step_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("at_s", "sim time from which on tags are stepped").in(0.0, 1e9).required(), self.at_s);
    visit(Field("step_s", "how much later the tags are from there on").in(-10.0, 10.0).required(), self.step_s);
  }
};

/// How the clock of a sensor errs that tags its samples, a part of the profile of every kind of sensor. Errors are tag
/// less time of validity; the law stands in models/timing/sensor_clock.hpp.
struct TimeTagErrors {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
  double white_sigma_s = 0.0;
  double gm_sigma_s = 0.0;
  double gm_correlation_time_s = 0.0;
  double quantization_s = 0.0;
  std::vector<TimeTagStep> steps;

  bool are_none() const {
    return offset_s == 0.0 && drift_ppm == 0.0 && white_sigma_s == 0.0 && gm_sigma_s == 0.0 && quantization_s == 0.0 &&
           steps.empty();
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("offset_s", "how much later than the time of validity the tag is").in(-10.0, 10.0), self.offset_s);
    visit(Field("drift_ppm", "of the sensor's oscillator, from when the profile came into use: above 0 it is fast")
              .in(-1e3, 1e3),
          self.drift_ppm);
    visit(Field("white_sigma_s", "jitter of each tag: standard deviation").in(0.0, 1.0), self.white_sigma_s);
    visit(Field("gm_sigma_s", "Gauss-Markov jitter: steady-state standard deviation").in(0.0, 1.0), self.gm_sigma_s);
    visit(Field("gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.gm_correlation_time_s);
    visit(Field("quantization_s", "tags are whole multiples of it in the week; 0: of a nanosecond").in(0.0, 1.0),
          self.quantization_s);
    visit(Field("steps", "of the clock, in order of time").at_most(16), self.steps);
  }
};

}  // namespace samples
}  // namespace inslab
