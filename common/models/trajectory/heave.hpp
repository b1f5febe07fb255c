#pragma once

#include "inslab/models/trajectory/vehicle_attitude.hpp"
#include "inslab/scenario/vehicle_class.hpp"

namespace inslab::trajectory {

/// A ship's height over that of its path: amplitude sin(2 pi t/period) along the ellipsoid's normal, which leaves
/// latitude and longitude as they are. t is sim time; without an amplitude there is none.
struct Heave {
  double amplitude_m = 0.0;
  double period_s = 1.0;

  /// Height over the path and its first two derivatives, upward.
  struct Instant {
    double up_m = 0.0;
    double up_m_per_s = 0.0;
    double up_m_per_s2 = 0.0;
  };
  Instant at(double t_s) const;
  bool is_none() const { return amplitude_m == 0.0; }
};

/// That of the class: a ship's.
Heave heave_of(const scenario::VehicleAttitude& attitude);

/// What heave adds to the velocity and the acceleration of a path, relative to the Earth, in the place's n. The normal
/// turns with the place, so each has a part along the track: with r the path and d the unit vector down in e, these are
/// the derivatives of -up d.
struct HeaveMotion {
  nav::Vector3 v_n = nav::Vector3::Zero();  ///< m/s
  nav::Vector3 a_n = nav::Vector3::Zero();  ///< m/s^2
};
HeaveMotion heave_motion(const PathInstant& path, const Heave::Instant& heave);

}  // namespace inslab::trajectory
