#pragma once

#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab {
inline namespace samples {

/// A place on the ladder that a receiver climbs after it lost its signals: the kind of a solution worse than the
/// profile's own, and how long it lasts.
struct SolutionRung {
  FixType fix_type = FixType::None;
  double lasts_s = 0.0;
  double mean_time_between_falls_s = 0.0;

  /// Listed by the structs that are a solution on the ladder.
  template <class Self, class Visitor>
  static void rung_fields(Self& self, Visitor& visit) {
    visit(Field("fix_type", "none: no fix").required(), self.fix_type);
    visit(Field("lasts_s", "until the next better solution").in(0.0, 1e6).required(), self.lasts_s);
    visit(Field("mean_time_between_falls_s", "mean of the exponential time between falls to it from a better; 0: never")
              .in(0.0, 1e7),
          self.mean_time_between_falls_s);
  }
};

}  // namespace samples
}  // namespace inslab
