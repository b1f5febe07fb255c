#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::scenario {

/// How an attitude is made from a path that has none: the nose points along the velocity, and the vehicle banks as it
/// turns (math in docs/models.md).
struct PathAttitude {
  double max_bank_deg = 30.0;
  double standstill_speed_m_per_s = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("max_bank_deg", "the bank of a coordinated turn is cut off here; 0: a vehicle that stays level")
              .in(0.0, 85.0),
          self.max_bank_deg);
    visit(Field("standstill_speed_m_per_s", "horizontal speed below which yaw and pitch stay as they are")
              .in(1e-3, 100.0),
          self.standstill_speed_m_per_s);
  }
};

}  // namespace inslab::scenario
