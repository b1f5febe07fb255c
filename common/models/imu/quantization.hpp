#pragma once

#include <cmath>

#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 5c: increments are whole numbers of counts. What a count cannot show is carried into the next interval, so
/// sums of increments stay within half a count of what was sensed.
class Quantization {
 public:
  explicit Quantization(const TriadParameters& parameters) { retune(parameters); }

  bool is_off() const { return count_.isZero(0.0); }

  /// Takes another count between two intervals; the remainder is carried on where there is still a count.
  void retune(const TriadParameters& parameters) {
    count_ = parameters.quantization;
    for (int axis = 0; axis < 3; ++axis) {
      if (count_[axis] == 0.0) remainder_[axis] = 0.0;
    }
  }

  void reset() { remainder_.setZero(); }

  /// The increment in whole counts, rad | m/s.
  Vector3 quantized(const Vector3& increment) {
    Vector3 out = increment;
    for (int axis = 0; axis < 3; ++axis) {
      if (count_[axis] == 0.0) continue;
      const double due = increment[axis] + remainder_[axis];
      // Adding and taking off 1.5 * 2^52 rounds to the nearest whole number in the FPU, half to even. A count below the
      // increment's own resolution has nothing to round.
      constexpr double kRounder = 0x1.8p52;
      const double exact = due / count_[axis];
      out[axis] = std::abs(exact) < 0x1p51 ? ((exact + kRounder) - kRounder) * count_[axis] : due;
      remainder_[axis] = due - out[axis];
    }
    return out;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.remainder_);
  }

 private:
  Vector3 count_ = Vector3::Zero();      ///< rad | m/s
  Vector3 remainder_ = Vector3::Zero();  ///< rad | m/s
};

}  // namespace inslab::imu
