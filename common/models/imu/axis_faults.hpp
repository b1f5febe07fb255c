#pragma once

#include <array>
#include <limits>

#include "inslab/data/profiles/fault_profile.hpp"

namespace inslab::imu {

/// Stage 5d: faults of single axes: one repeats the last increment it put out before, shows the wrong sign, or gives
/// NaN.
class AxisFaults {
 public:
  void set(const std::array<AxisFault, 3>& faults) {
    faults_ = faults;
    is_off_ = faults == std::array<AxisFault, 3>{};
  }

  /// What comes out for `increment`, rad | m/s.
  Vector3 applied(const Vector3& increment) {
    if (is_off_) return last_ = increment;
    Vector3 out = increment;
    for (int axis = 0; axis < 3; ++axis) {
      switch (faults_[axis]) {
        case AxisFault::None:
          break;
        case AxisFault::Stuck:
          out[axis] = last_[axis];
          break;
        case AxisFault::SignFlip:
          out[axis] = -increment[axis];
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

  /// What goes on from sample to sample (recovery/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.last_);
  }

 private:
  std::array<AxisFault, 3> faults_{};
  bool is_off_ = true;
  Vector3 last_ = Vector3::Zero();  ///< rad | m/s
};

}  // namespace inslab::imu
