#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// How the pulse per second of a receiver errs, a part of its profile. Errors are rise less the whole second that the
/// pulse marks; the law stands in models/gnss/pulse_generator.hpp.
struct PulseErrors {
  bool on = false;
  double offset_ns = 0.0;
  double white_sigma_ns = 0.0;
  double quantization_ns = 0.0;
  double oscillator_drift_ppb = 0.0;
  double missing_probability = 0.0;
  double holdover_s = 0.0;
  double holdover_drift_ppb = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("on", "whether the receiver gives pulses"), self.on);
    visit(Field("offset_ns", "of antenna, cable and receiver: how much later each rises").in(-1e6, 1e6),
          self.offset_ns);
    visit(Field("white_sigma_ns", "jitter of each pulse: standard deviation").in(0.0, 1e5), self.white_sigma_ns);
    visit(Field("quantization_ns",
                "a pulse rises with the nearest tick of the receiver's oscillator, of this period; 0: "
                "at any time")
              .in(0.0, 1e5),
          self.quantization_ns);
    visit(
        Field("oscillator_drift_ppb", "of that oscillator: above 0 it is fast; what makes the sawtooth").in(-1e6, 1e6),
        self.oscillator_drift_ppb);
    visit(Field("missing_probability", "of each pulse, to be left out").in(0.0, 1.0), self.missing_probability);
    visit(Field("holdover_s", "without a fix for longer there are no pulses").in(0.0, 1e4), self.holdover_s);
    visit(Field("holdover_drift_ppb", "of the time that the receiver keeps meanwhile: nanoseconds a second")
              .in(-1e3, 1e3),
          self.holdover_drift_ppb);
  }
};

}  // namespace samples
}  // namespace inslab
