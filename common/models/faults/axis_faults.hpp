#pragma once

#include <array>
#include <limits>

#include "inslab/data/profiles/fault_profile.hpp"

namespace inslab::faults {

/// Faults of the single axes of a triad: one repeats the last value it put out before, shows the wrong sign, or gives
/// NaN.
class AxisFaults {
 public:
  void set(const std::array<AxisFault, 3>& faults) {
    faults_ = faults;
    is_off_ = faults == std::array<AxisFault, 3>{};
  }

  /// What comes out for `value`.
  Vector3 applied(const Vector3& value) {
    if (is_off_) return last_ = value;
    Vector3 out = value;
    for (int axis = 0; axis < 3; ++axis) {
      switch (faults_[axis]) {
        case AxisFault::None:
          break;
        case AxisFault::Stuck:
          out[axis] = last_[axis];
          break;
        case AxisFault::SignFlip:
          out[axis] = -value[axis];
          break;
        case AxisFault::Nan:
          out[axis] = std::numeric_limits<double>::quiet_NaN();
          break;
      }
      if (faults_[axis] != AxisFault::Stuck) last_[axis] = out[axis];
    }
    return out;
  }

  bool is_off() const { return is_off_; }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.last_);
  }

 private:
  std::array<AxisFault, 3> faults_{};
  bool is_off_ = true;
  Vector3 last_ = Vector3::Zero();
};

}  // namespace inslab::faults
