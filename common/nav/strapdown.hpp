#pragma once

#include <optional>

#include "inslab/nav/compensated_quaternion.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::nav {

/// Where a body is, how fast, and which way it looks.
struct NavState {
  Geodetic position;
  Vector3 v_n = Vector3::Zero();             ///< m/s, relative to the Earth
  Quaternion q_nb = Quaternion::Identity();  ///< v_n = C(q_nb) v_b
};

/// What a strapdown IMU puts out for one interval: integrals in the moving b axes.
struct ImuIncrements {
  Vector3 dtheta_b = Vector3::Zero();  ///< rad, of omega_ib_b
  Vector3 dv_b = Vector3::Zero();      ///< m/s, of f_b
  double dt_s = 0.0;
};

/// The two-sample strapdown mechanization in n: thesis (2-29)..(2-57), with the corrections of docs/models.md.
///
/// Each interval uses the one before for its coning (2-53) and sculling (2-32) terms, under the assumption of rate and
/// specific force linear in time. The printed factor of these terms, 1/12, is that of equal intervals; intervals S and
/// then T have T^2 / (6 S (S + T)). Position is carried as the quaternion of (2-42) with compensated sums, or its
/// roundings would add up to 0.1 mm in 20 minutes at 200 Hz.
class Strapdown {
 public:
  struct Options {
    /// Keeps the term 1/6 dtheta x (dtheta x dv) that (2-32) drops: without it velocity is of second order in the
    /// interval, with it of fourth in oscillating motion.
    bool full_rotation_term = false;
  };

  /// `before` is the interval that ends at the start. Without it the first interval has no coning and sculling terms
  /// and takes the start's velocity for the middle one's. Throws std::domain_error where check_domain() does and when
  /// start.q_nb is no rotation; std::invalid_argument when before->dt_s is not positive.
  Strapdown(const NavState& start, const Gravity& gravity, const Options& options,
            const std::optional<ImuIncrements>& before = std::nullopt);

  /// Carries the state over one interval. Throws std::invalid_argument unless dt_s is positive. Does not check the
  /// domain: near a pole n has no meaning, and neither has the result.
  void advance(const ImuIncrements& imu);

  /// The exact inverse: the increments that make advance() arrive at this velocity (m/s) and attitude, to rounding;
  /// position follows from the velocity. Thesis 3.2.2, with the corrections of docs/models.md to (3-41) and (3-44).
  /// Throws as advance().
  ImuIncrements increments_to(const Vector3& v_n, const Quaternion& q_nb, double dt_s) const;

  /// Sets height (m) and vertical velocity (m/s, down), as a perfect barometer would; the horizontal channels go on as
  /// they are. Without it the height of pure inertial navigation doubles its error every 395 s (lecture (72)).
  void hold_vertical(double height_m, double v_d_m_per_s);

  NavState state() const;
  Geodetic position() const;
  const Vector3& v_n() const { return v_n_; }
  Quaternion q_nb() const;  ///< canonical

 private:
  /// What does not depend on the interval's own increments.
  struct Extrapolated {
    double sin_latitude;  ///< at the interval's middle, as is all of this
    double cos_latitude;
    Vector3 half_zeta_n;  ///< half the rotation of n over the interval, rad
    Vector3 dv_gcor_n;    ///< gravity's and Coriolis' share of the interval, m/s
  };

  /// The position at the interval's end with the rotation of n that attitude sees.
  struct Moved {
    CompensatedQuaternion q_en;
    CompensatedSum height_m;
    Vector3 zeta_n;  ///< rad
  };

  Extrapolated extrapolate(double dt_s) const;
  Moved move(const Extrapolated& middle, const Vector3& v_n, double dt_s) const;
  double two_sample_factor(double dt_s) const;

  Gravity gravity_;
  Options options_;
  CompensatedQuaternion q_en_;
  CompensatedSum height_m_;
  Vector3 v_n_;
  CompensatedQuaternion q_nb_;
  ImuIncrements before_;                   ///< dt_s 0: there was none
  Vector3 dv_n_before_ = Vector3::Zero();  ///< change of v_n in the interval before, m/s
};

}  // namespace inslab::nav
