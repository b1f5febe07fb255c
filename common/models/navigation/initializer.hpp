#pragma once

#include <optional>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/models/navigation/inertial_filter.hpp"
#include "inslab/models/navigation/motion_alignment.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/nav/strapdown.hpp"

namespace inslab::navigation {

/// Where and how surely the filter begins.
struct Beginning {
  std::int64_t time_ns = 0;
  nav::NavState state;
  Estimates errors;
  StateMatrix covariance;  ///< of the layout that the parameters choose
};

/// Standard deviations of the attitude that `span_s` of rest gives at a latitude, rad about north, east, down: tilts
/// are accelerometer errors over gravity, heading is the error of the east gyro over the Earth's horizontal rate,
///
///   sigma_heading^2 = (N^2 / T + B^2) / (omega_ie cos(latitude))^2,
///
/// N the angle random walk, B the bias (P. Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation
/// Systems, 2nd edition (2013), 5.6.2).
Vector3 alignment_sigmas(const NavigationParameters& parameters, double span_s, double latitude_rad,
                         double gravity_m_per_s2);

/// Finds the state that the filter begins with, from IMU samples and fixes.
///
/// With static_alignment rest comes first; where it is too short, the vehicle sways or the gyros do not feel the Earth,
/// MotionAlignment takes over as soon as the velocity changes.
class Initializer {
 public:
  Initializer(const NavigationParameters& parameters, const nav::Gravity& gravity);

  /// Keeps the newest fix. One that says that the antenna moves begins the alignment anew: the forces of a steady turn
  /// look like a tilt.
  void add(const GnssFix& fix);

  /// Takes a valid sample; the beginning, at its end, once there is one. When the IMU moved during the alignment, or
  /// its gyros do not feel the Earth, begins the alignment anew and keeps the reason.
  std::optional<Beginning> add(const ImuSample& sample);

  /// Why the last alignment at rest was refused; empty when none was.
  const std::string& refusal() const { return refusal_; }
  /// Why there is none by motion.
  const std::string& motion_refusal() const { return motion_.why_not(); }

 private:
  std::optional<Matrix3> attitude();
  double sway_rad() const;
  Vector3 static_sigmas() const;
  void doubt_attitude(const Matrix3& C_nb, StateMatrix& P) const;
  Beginning at_rest(const ImuSample& sample, const Matrix3& C_nb) const;
  Beginning in_motion(const ImuSample& sample, const MotionAlignment::Result& result) const;
  void refuse(const std::string& reason);

  NavigationParameters parameters_;
  StateLayout layout_;
  nav::Gravity gravity_;
  MotionAlignment motion_;
  std::optional<GnssFix> fix_;
  std::string refusal_;
  double span_s_ = 0.0;
  double count_ = 0.0;
  Vector3 f_first_ = Vector3::Zero();
  Vector3 dtheta_sum_ = Vector3::Zero();
  Vector3 dv_sum_ = Vector3::Zero();
  Vector3 f_sum_ = Vector3::Zero();                ///< of differences from the first
  Vector3 f_squares_ = Vector3::Zero();            ///< the same
  std::vector<std::pair<double, Vector3>> turns_;  ///< time and sum of dtheta, a few times a second
};

}  // namespace inslab::navigation
