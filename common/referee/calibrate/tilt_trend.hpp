#pragma once

#include <optional>
#include <vector>

#include "inslab/nav/vectors.hpp"

namespace inslab::calibrate {

/// Means of an IMU over a second, or the whole number of samples next to one.
struct SecondMeans {
  nav::Vector3 omega_ib_b = nav::Vector3::Zero();  ///< rad/s
  nav::Vector3 f_b = nav::Vector3::Zero();         ///< m/s^2
};

/// How an IMU tilts over a recording, as a car does that settles on its springs.
///
/// The gyros feel it beside the Earth's rate, and the yaw of coarse alignment with them: 0.33 deg/h about east is 1.5
/// deg at 30 deg latitude. The specific force shows the same turn, so that it can be taken out. A drift of an
/// accelerometer's bias looks the same: 1 mGal an hour is 0.2 arcsec an hour.
struct TiltTrend {
  nav::Vector3 omega_nb_b = nav::Vector3::Zero();  ///< straight line through the tilt: horizontal, rad/s
  double sigma_rad_per_s = 0.0;                    ///< of each of its axes, from what neighbouring seconds differ by
  nav::Vector3 omega_ie_b = nav::Vector3::Zero();  ///< mean rate less the turn, rad/s

  /// Five sigma: noise alone does so once in 270 000 recordings.
  bool shows() const { return omega_nb_b.norm() > 5.0 * sigma_rad_per_s; }
};

/// Nothing for fewer than ten seconds, which are each `second_s` long.
///
/// The horizontal Earth rate is the slope of a straight line through the gyros' angles less the tilt, second by second,
/// so that a motion goes out whatever its course. This is alignment in the inertial frame to first order in the tilt.
std::optional<TiltTrend> tilt_trend(const std::vector<SecondMeans>& seconds, double second_s);

}  // namespace inslab::calibrate
