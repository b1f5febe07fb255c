#pragma once

#include "inslab/models/imu/installation.hpp"
#include "inslab/models/imu/low_pass.hpp"
#include "inslab/models/imu/motion_course.hpp"
#include "inslab/models/imu/size_effect.hpp"

namespace inslab::imu {

/// The perfect rates over an interval of the truth in b: quadratics with the truth's values at both ends and its exact
/// integrals. A jump of the angular rate at the end, rad/s, is not in the courses, nor is `impulse`, m/s, what it adds
/// through the arm.
struct MotionPiece {
  Course omega;
  Course f;
  Vector3 rate_jump = Vector3::Zero();
  Vector3 impulse = Vector3::Zero();
};
MotionPiece motion_piece(const Installation& installation, const TruthState& before, const TruthState& truth,
                         const Installation::Instant& start, const Installation::Instant& end,
                         const Increments& perfect);

/// The piece with what the accelerometers feel at their own places.
MotionPiece with_size_effect(const MotionPiece& piece, const SizeEffect& size_effect, double dt_s);

/// The answer of a triad's filters to the motion over one interval of the IMU, piece by piece of the truth, each with
/// the filter's exact transition: what the quadratics leave out is of third order in the truth's step. With an arm, and
/// where the force jumps or turns round, straight lines are left: second order.
class MotionResponse {
 public:
  void begin() {
    y_.setZero();
    slope_.setZero();
    integral_.setZero();
  }
  void add(const LowPasses& filters, const Course& course, const Vector3& impulse, double dt_s);
  /// Less the answer to the mean rate, which Bandwidth is solved for. `dt_s` is the interval's own length, so that of a
  /// steady input nothing is left.
  Unsteady about(const LowPasses& filters, const Vector3& mean, double dt_s);

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.y_, self.slope_, self.integral_);
  }

 private:
  Vector3 y_ = Vector3::Zero();
  Vector3 slope_ = Vector3::Zero();
  Vector3 integral_ = Vector3::Zero();
  TriadLowPassSteps pieces_, intervals_;
};

}  // namespace inslab::imu
