#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/models/trajectory/motion_segment.hpp"
#include "inslab/nav/compensated_quaternion.hpp"
#include "inslab/nav/compensated_sum.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::trajectory {

/// Exact integrals over a stretch of time, in the moving v axes.
struct Increments {
  Vector3 dtheta_v = Vector3::Zero();  ///< rad, of omega_iv_v
  Vector3 dv_v = Vector3::Zero();      ///< m/s, of f_v
};

/// The vehicle carried through continuous time along one segment after another:
///
///   q_nv' = 1/2 q_nv * omega_nv_v          v_n' = C_nv (a_lin_v + omega_nv_v x (C_vn v_n))
///   lat'  = v_N/(M+h)    lon' = v_E/((N+h) cos lat)    h' = -v_D
///
/// Method. With the velocity on the nose the second equation is (C_vn v_n)' = a_lin_v, so the velocity in v axes is the
/// closed-form integral of the segment's motions; angles about one axis are closed-form too, and those about several
/// differ by the coning integral of a step. What is left, position and the Earth's share of dtheta and dv, is slow:
/// Simpson's rule on each step. Sums are compensated.
///
/// In a ballistic segment a_lin_v and omega_nv_v are not given but follow from gravity and drag: the velocity keeps its
/// direction in v axes (the nose). Speed, attitude, position and increments are integrated together by the classical
/// Runge-Kutta method of fourth order, in axes that do not spin about the velocity; the spin itself is closed-form, and
/// drag, which lies along it, feels nothing of it.
/// Source: docs/models.md; thesis (3-23)..(3-32).
class VehicleMotion {
 public:
  /// `v_v` in m/s. The vehicle is at rest relative to v (endless uniform motion) until begin().
  VehicleMotion(const nav::Geodetic& position, const Vector3& v_v, const Quaternion& q_nv, const nav::Gravity& gravity);

  /// The next segment starts here. True when omega_nv_v jumps. A ballistic segment throws std::domain_error, here and
  /// in step(), while the vehicle is slower than 1 m/s: the attitude has no velocity to follow.
  bool begin(MotionSegment segment);

  /// Integrates from `t0_s` to `t1_s` of the segment; no corner lies between, and `t0_s` is where the last step ended.
  /// `dt_s` is t1 - t0 from whole nanoseconds: the difference of two doubles would err by 1e-13 s after an hour.
  void step(double t0_s, double t1_s, double dt_s);

  /// A step as long as this keeps the promised accuracy: 5 ms, less where the motion is fast.
  double longest_step_s() const;

  /// The increments since the last call.
  Increments take_increments();

  const MotionSegment& segment() const { return segment_; }
  nav::Geodetic position() const;
  Quaternion q_nv() const;  ///< canonical
  const Vector3& v_n() const { return now_.v_n; }
  Vector3 v_v() const { return now_.C_nv.transpose() * now_.v_n; }
  Vector3 omega_iv_v() const { return now_.motion.omega_nv_v + now_.omega_in_v; }
  Vector3 f_v() const {
    return segment_.is_ballistic() ? drag_v(now_) : now_.motion.a_lin_v + now_.turning_v() + now_.f_earth_v;
  }

 private:
  /// All quantities of one time.
  struct Instant {
    MotionInstant motion;
    Matrix3 C_nv = Matrix3::Identity();
    Vector3 v_n = Vector3::Zero();
    Vector3 position_rate = Vector3::Zero();  ///< lat', lon', h'
    Vector3 omega_in_v = Vector3::Zero();
    Vector3 f_earth_v = Vector3::Zero();  ///< of f_v: Coriolis and gravity
    Vector3 nose_v = Vector3::Zero();     ///< v_v while it is kept on the nose, or else 0
    double inverse_north_m = 0.0;         ///< 1/(M+h)
    /// Of f_v: the acceleration that keeps the velocity on the nose.
    Vector3 turning_v() const { return motion.omega_nv_v.cross(nose_v); }
  };

  /// Since the start of a ballistic step: latitude, longitude, height; speed; rotation vector of v; dtheta_v; dv_v.
  using FallChange = Eigen::Matrix<double, 13, 1>;

  void fall(double t0_s, double t1_s, double dt_s);
  FallChange fall_rate(const FallChange& change) const;
  Instant falling(const Quaternion& q_nv, double speed_m_per_s, const nav::Geodetic& position) const;
  void spin_to(double t_s);
  Vector3 drag_v(const Instant& instant) const;
  void evaluate(Instant& instant, const nav::Geodetic& position) const;
  void find_velocities(Instant& middle, Instant& end, double dt_s);
  Vector3 turning(const Instant& middle, const Instant& end, double dt_s) const;
  void add_to_position(const Vector3& change);

  nav::Gravity gravity_;
  MotionSegment segment_;
  nav::CompensatedSum latitude_rad_;
  nav::CompensatedSum longitude_rad_;
  nav::CompensatedSum height_m_;
  nav::CompensatedQuaternion q_nv_;  ///< of a ballistic segment without what it has spun
  Quaternion spun_ = Quaternion::Identity();
  nav::CompensatedSum v_n_[3];         ///< carried only while the velocity is not kept on the nose
  Vector3 v_v_at_start_;               ///< of the segment
  nav::CompensatedSum speed_m_per_s_;  ///< of a ballistic segment, with its direction
  Vector3 along_v_ = Vector3::UnitX();
  Instant now_;
  Increments increments_;
};

}  // namespace inslab::trajectory
