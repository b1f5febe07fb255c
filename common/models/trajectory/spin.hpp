#pragma once

#include "inslab/foundation/fields/field.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::trajectory {

/// How a vehicle spins about one of its own axes while the air slows it: p(t) = p(0) exp(-t/decay).
class Spin {
 public:
  Spin() = default;
  /// `decay_s` 0: nothing slows it.
  Spin(double rate_rad_per_s, double decay_s) : rate_rad_per_s_(rate_rad_per_s), decay_s_(decay_s) {}

  bool is_none() const { return rate_rad_per_s_ == 0.0; }
  double rate_rad_per_s(double t_s) const;
  /// Turned through since time 0, without an end.
  double angle_rad(double t_s) const { return turned_rad(0.0, t_s); }
  /// Turned through in `dt_s` from `t_s` on: a difference of two angles after many turns would be rounded.
  double turned_rad(double t_s, double dt_s) const;

  /// The integral over `dt_s` from `t0_s` on of a vector in the spinning axes. Given are its values at the start, the
  /// middle and the end in axes that do not spin, and coincide with these at time 0; between them it is their parabola.
  /// `along` is the unit vector of the axis. What lies across it turns, as often as it may in that time: Gauss's rule
  /// of five points on each radian errs by 4e-13 of it.
  Vector3 integral_in_spinning_axes(const Vector3& along, const Vector3& start, const Vector3& middle,
                                    const Vector3& end, double t0_s, double dt_s) const;

 private:
  double rate_rad_per_s_ = 0.0;  ///< at time 0
  double decay_s_ = 0.0;
};

}  // namespace inslab::trajectory
