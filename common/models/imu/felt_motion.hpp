#pragma once

#include "inslab/models/imu/motion_response.hpp"
#include "inslab/models/imu/triad_delay.hpp"

namespace inslab::imu {

/// The motion as one triad feels it over an interval of the IMU: late by its delay, and with its filters' answer. Both
/// do the same at any time, so it is one whether the filter is late or its input.
class FeltMotion {
 public:
  /// Takes another delay between two intervals; see TriadDelay::retune.
  void retune(std::int64_t delay_ns) { delay_.retune(delay_ns); }
  bool is_late() const { return !delay_.is_off(); }
  std::int64_t delay_ns() const { return delay_.delay_ns(); }
  void relocate() { delay_.forget(); }

  void begin() {
    response_.begin();
    late_.setZero();
  }
  /// The next stretch of the motion.
  void add(const LowPasses& filters, const MotionStretch& stretch) {
    if (is_late()) {
      delay_.add(stretch);
    } else {
      response_.add(filters, stretch.course, stretch.impulse, stretch.length_s());
    }
  }
  /// The interval has ended, its stretches are all there.
  void end(const LowPasses& filters, std::int64_t from_ns, std::int64_t to_ns) {
    if (!is_late()) return;
    delay_.late(from_ns, to_ns, [&](const MotionStretch& stretch) {
      late_ += stretch.integral();
      response_.add(filters, stretch.course, stretch.impulse, stretch.length_s());
    });
  }

  /// What a late triad felt of the interval that has ended, rad | m/s.
  const Vector3& late() const { return late_; }
  /// MotionResponse::about of it.
  Unsteady about(const LowPasses& filters, const Vector3& mean, double dt_s) {
    return response_.about(filters, mean, dt_s);
  }

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.response_, self.delay_);
  }

 private:
  TriadDelay delay_;
  MotionResponse response_;
  Vector3 late_ = Vector3::Zero();
};

}  // namespace inslab::imu
