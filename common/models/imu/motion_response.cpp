#include "inslab/models/imu/motion_response.hpp"

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::imu {

MotionPiece motion_piece(const Installation& installation, const TruthState& before, const TruthState& truth,
                         const Installation::Instant& start, const Installation::Instant& end,
                         const Increments& perfect) {
  const double dt_s = time::to_seconds(truth.interval_ns);
  const Matrix3& C_bv = installation.C_bv();
  const Vector3& arm = installation.lever_arm_v_m();
  const Course omega = Course::through(start.omega_iv_v, end.omega_iv_v, truth.dtheta_v / dt_s, truth.rate_jump);
  Course f = Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s, false);
  if (truth.rate_jump || jumps(f)) f = Course::through(before.f_v, truth.f_v, truth.dv_v / dt_s, true);

  MotionPiece piece;
  piece.omega = {C_bv * omega.mean, C_bv * omega.slope, C_bv * omega.curve};
  if (truth.rate_jump) {
    const Vector3 jump = end.omega_iv_v - omega.at(1.0);
    piece.rate_jump = C_bv * jump;
    piece.impulse = C_bv * jump.cross(arm);
  }
  const auto at_imu = [&](double x, const Vector3& gravitation_difference_v) {
    const Vector3 rate = omega.at(x), alpha = (2.0 / dt_s) * (omega.slope + 3.0 * x * omega.curve);
    return Vector3(C_bv * (f.at(x) + alpha.cross(arm) + rate.cross(rate.cross(arm)) + gravitation_difference_v));
  };
  piece.f = Course::through(at_imu(-1.0, start.gravitation_difference_v), at_imu(1.0, end.gravitation_difference_v),
                            (perfect.dv - piece.impulse) / dt_s, false);
  return piece;
}

MotionPiece with_size_effect(const MotionPiece& piece, const SizeEffect& size_effect, double dt_s) {
  const Course& omega = piece.omega;
  const auto felt_at = [&](double x) {
    const Vector3 alpha = (2.0 / dt_s) * (omega.slope + 3.0 * x * omega.curve);
    return Vector3(piece.f.at(x) + size_effect.of_alpha(alpha) + size_effect.of_rate(omega.at(x)));
  };
  const Vector3 mean = piece.f.mean + size_effect.increment(omega, Vector3::Zero(), dt_s) / dt_s;
  MotionPiece felt = piece;
  felt.f = Course::through(felt_at(-1.0), felt_at(1.0), mean, false);
  felt.impulse += size_effect.of_alpha(piece.rate_jump);
  return felt;
}

void MotionResponse::add(const LowPasses& filters, const Course& course, const Vector3& impulse, double dt_s) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    const LowPass& filter = filters[n];
    if (filter.order() == 0) continue;
    const double mean = course.mean[axis];
    // About the mean the filter decays from where it is, and follows the rest of the course.
    const LowPass::State left =
        pieces_[n].decayed(filter, {y_[axis] - mean, slope_[axis], integral_[axis] + mean * dt_s}, dt_s);
    const LowPass::State rest = pieces_[n].after_course(filter, course.slope[axis], course.curve[axis], dt_s);
    const LowPass::State jump = filter.after_impulse();
    y_[axis] = mean + left.y + rest.y + impulse[axis] * jump.y;
    slope_[axis] = left.slope + rest.slope + impulse[axis] * jump.slope;
    integral_[axis] = left.integral + rest.integral;
  }
}

Unsteady MotionResponse::about(const LowPasses& filters, const Vector3& mean, double dt_s) {
  Unsteady unsteady;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    const LowPass& filter = filters[n];
    if (filter.order() == 0) continue;
    const LowPass::State left = intervals_[n].decayed(filter, {-mean[axis], 0.0, mean[axis] * dt_s}, dt_s);
    unsteady.add(axis, {y_[axis] - mean[axis] - left.y, slope_[axis] - left.slope, integral_[axis] - left.integral});
  }
  return unsteady;
}

}  // namespace inslab::imu
