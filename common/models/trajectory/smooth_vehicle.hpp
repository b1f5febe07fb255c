#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::trajectory {

/// A vehicle carried along two curves. With r_k the displacement from the origin of the piece it is on, in that
/// origin's north, east and down (frame k, fixed to the Earth):
///
///   omega_iv_v = omega_ev_v + C_vk omega_ie_k      f_v = C_vk (r_k'' + 2 omega_ie_k x r_k' - g_k)
///
/// where a ship's heave is added to r_k. Position, velocity and attitude are the curves themselves; only the increments
/// are quadratures: Gauss's rule of three nodes (exact to the fifth degree) on steps of at most 5 ms, less where the
/// vehicle turns fast, split at every joint of either curve.
class SmoothVehicle {
 public:
  /// The motion begins at time 0 and must outlive the vehicle. Throws std::domain_error where geodesy does.
  SmoothVehicle(const SmoothMotion& motion, const nav::Gravity& gravity);

  /// Goes on to `end`, later than now(). Throws std::out_of_range when the motion has ended before.
  void advance(time::Nanoseconds end);

  time::Nanoseconds now() const { return now_; }
  const nav::Geodetic& position() const { return here_.position; }
  const Vector3& v_n() const { return here_.v_n; }
  Quaternion q_nv() const;  ///< canonical
  const Vector3& omega_iv_v() const { return here_.omega_iv_v; }
  const Vector3& f_v() const { return here_.f_v; }
  /// Integrals of omega_iv_v and f_v over the last advance().
  const Vector3& dtheta_v() const { return dtheta_v_; }
  const Vector3& dv_v() const { return dv_v_; }
  /// Of the piece of the path that begins at or contains now().
  std::uint32_t piece_index() const { return piece_.index; }

 private:
  /// What is published of one time.
  struct Instant {
    nav::Geodetic position;
    Matrix3 C_nk = Matrix3::Identity();
    Vector3 position_rate = Vector3::Zero();  ///< lat', lon', h'
    Vector3 v_n = Vector3::Zero();
    Vector3 g_k = Vector3::Zero();
    Vector3 omega_iv_v = Vector3::Zero();
    Vector3 f_v = Vector3::Zero();
  };
  /// Rate and specific force of one time.
  struct Forces {
    Vector3 omega_iv_v;
    Vector3 f_v;
  };

  void begin_path_piece();
  void begin_rotation_piece();
  void meet_pieces();
  void step(time::Nanoseconds end);
  time::Nanoseconds longest_step() const;
  void place(double path_time_s, Instant& instant) const;
  Heave::Instant heave(double path_time_s) const;
  Matrix3 C_kn_at(double latitude_rad, double longitude_rad) const;
  Vector3 g_k_between(const Instant& start, const Instant& end, double dt_s) const;
  Forces forces(double path_time_s, double rotation_time_s, const Vector3& g_k) const;

  const SmoothMotion& motion_;
  nav::Gravity gravity_;
  time::Nanoseconds now_{0};
  std::size_t path_index_ = 0;
  std::size_t rotation_index_ = 0;
  PathPiece piece_;
  time::Nanoseconds rotation_start_{0};
  time::Nanoseconds rotation_end_{0};
  nav::RotationPiece rotation_;
  Matrix3 C_ek_ = Matrix3::Identity();
  Vector3 omega_ie_k_ = Vector3::Zero();
  Matrix3 C_vk_at_rotation_start_ = Matrix3::Identity();
  Instant here_;
  Vector3 dtheta_v_ = Vector3::Zero();
  Vector3 dv_v_ = Vector3::Zero();
};

}  // namespace inslab::trajectory
