#pragma once

#include <array>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/geodesy.hpp"

/// The path of a live vehicle between and beyond the states that were received, as polynomials of the time. Positions
/// are displacements in e from a piece's origin, so that neither poles nor the antimeridian disturb them.
namespace inslab::trajectory {

/// A received state at the instant of the truth that it stands for.
struct VehicleKnot {
  time::Nanoseconds time{0};
  nav::Geodetic position;
  Vector3 v_n = Vector3::Zero();  ///< m/s
  Vector3 a_n = Vector3::Zero();  ///< m/s^2, time derivative of v_n, component by component
  Quaternion q_nv = Quaternion::Identity();
  Vector3 omega_nv_v = Vector3::Zero();  ///< rad/s
};

/// A vector-valued polynomial of time since its start, in s.
template <std::size_t n>
struct VectorPolynomial {
  std::array<Vector3, n + 1> coefficients;

  Vector3 value(double t_s) const;
  Vector3 rate(double t_s) const;
  Vector3 second_rate(double t_s) const;
};

/// Where the vehicle is at one instant, relative to a piece's origin.
struct LivePathPoint {
  Vector3 r_e = Vector3::Zero();  ///< m, from the origin
  Vector3 v_e = Vector3::Zero();  ///< m/s, derivative of r_e
  Vector3 a_e = Vector3::Zero();  ///< m/s^2, second derivative of r_e
  Quaternion q_nv = Quaternion::Identity();
  Vector3 omega_nv_v = Vector3::Zero();  ///< rad/s, exactly that of q_nv
};

/// One piece of the path. Between two knots the velocity is a cubic with both velocities and accelerations, the
/// position its integral from the first knot's; the attitude is a cubic rotation vector with both attitudes and rates.
///
/// The position of the second knot is not used: velocities say where it is to T^5/720 of the velocity's fourth
/// derivative, while a curve bent to meet it would turn each contradiction of position and velocity, be it the rounding
/// of a longitude (1e-9 m) or a simulator's Euler step, into an acceleration 6/T^2 times as large. The contradiction
/// becomes an offset instead, which LivePathOffset leads back.
class LivePathPiece {
 public:
  static LivePathPiece between(const VehicleKnot& from, const VehicleKnot& to);

  /// On from a knot: its acceleration and its rate fade, as (1 - t/fading)^2, to nothing after `fading_s`; the velocity
  /// that results goes on. Not to be asked later than that; before the knot it is what a_n and omega_nv_v of 0 make it.
  static LivePathPiece beyond(const VehicleKnot& from, double fading_s);

  time::Nanoseconds start() const { return start_; }
  const nav::Geodetic& origin() const { return origin_; }
  const Matrix3& C_en() const { return C_en_; }  ///< at the origin

  LivePathPoint at(double since_start_s) const;

 private:
  explicit LivePathPiece(const VehicleKnot& from);

  time::Nanoseconds start_{0};
  nav::Geodetic origin_;
  Matrix3 C_en_;
  VectorPolynomial<4> r_e_{};
  Quaternion q_nv_;
  VectorPolynomial<3> Phi_{};  ///< q_nv = q_nv_ * exp(Phi)
};

/// What leads the truth back to the states: the difference between where it is and where they say it should be, which
/// dies out, e^(-k t) times a polynomial of t, so smoothly that position keeps two continuous derivatives and attitude
/// one. Of a pure difference of position 99 % are gone after `return_time`, of one of attitude sooner.
class LivePathOffset {
 public:
  /// None.
  explicit LivePathOffset(double return_time_s);

  /// Begins anew: `is` and `should_be` are at the same instant, from the same origin.
  void begin(time::Nanoseconds start, const LivePathPoint& is, const LivePathPoint& should_be);

  time::Nanoseconds start() const { return start_; }
  double decay_per_s() const { return k_; }

  /// `point` with what is left of the difference `since_start_s` later.
  LivePathPoint added_to(const LivePathPoint& point, double since_start_s) const;

 private:
  double k_;
  time::Nanoseconds start_{0};
  VectorPolynomial<2> r_e_;
  VectorPolynomial<1> Phi_;
};

}  // namespace inslab::trajectory
