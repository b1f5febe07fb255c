#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::navigation {

using nav::Matrix3;
using nav::Quaternion;
using nav::Vector3;

/// Attitude and velocity of an IMU that moves, by matching velocities: what the IMU's force sums up to in the axes that
/// it began with, b0, against what the receiver's velocity says in the n that it began in, n0:
///
///   C_n0n v_n = v_0 + C_n0b0 alpha + integral of C_n0n (g_n - omega_ie_n x v_n),   alpha = integral of C_b0b f_b
///
/// Unknown are C_n0b0, v_0 and constant biases, which the parameters' sigmas hold: Wahba's problem by its singular
/// values for a start from nowhere, then Gauss-Newton with the covariance that belongs to it. It needs no rest and no
/// nose along the track, but a change of velocity: heading is known to sigma_v/|change|. Sources: Y. Wu, X. Pan,
/// Velocity/position integration formula (2013); F. Markley, Attitude determination using vector observations and the
/// singular value decomposition (1988).
class MotionAlignment {
 public:
  MotionAlignment(const NavigationParameters& parameters, const nav::Gravity& gravity);

  /// A fix with a velocity; one that is valid in the past counts at its own time.
  void add(const GnssFix& fix);

  /// A valid sample. One that does not follow the last begins the alignment anew.
  void add(const ImuSample& sample);

  struct Result {
    Matrix3 C_nb = Matrix3::Identity();
    Vector3 v_n = Vector3::Zero();         ///< of the IMU, m/s
    Vector3 gyro_bias = Vector3::Zero();   ///< rad/s
    Vector3 accel_bias = Vector3::Zero();  ///< m/s^2
    /// Of the errors, each the estimate less the truth: velocity, attitude (C_nb is (I - [phi x]) times the true one),
    /// gyro bias, accelerometer bias.
    Eigen::Matrix<double, 12, 12> covariance = Eigen::Matrix<double, 12, 12>::Zero();
  };
  /// At the end of the newest sample, when heading and tilt have become sure enough to begin with.
  const std::optional<Result>& result() const { return result_; }

  /// What is missing, in words; empty when there is a result.
  const std::string& why_not() const { return why_not_; }

 private:
  /// The IMU's side and the Earth's, both integrated to one instant.
  struct Integrals {
    std::int64_t time_ns = 0;
    Quaternion q_b0b = Quaternion::Identity();
    Vector3 alpha_b0 = Vector3::Zero();       ///< m/s
    Matrix3 by_accel_bias = Matrix3::Zero();  ///< alpha by a bias of the forces, negative; s
    Matrix3 by_gyro_bias = Matrix3::Zero();   ///< alpha by a bias of the rates
    Vector3 omega_ib_b = Vector3::Zero();
    double turned_rad = 0.0;  ///< all turns, whichever way
    Quaternion q_n0n = Quaternion::Identity();
    Vector3 fall_n0 = Vector3::Zero();  ///< integral of gravity and what the Earth's turn adds, m/s
  };
  /// A fix against the integrals of its time.
  struct Match {
    Integrals at;
    Vector3 y_n0 = Vector3::Zero();  ///< the antenna's velocity less the fall
    Vector3 a_b0 = Vector3::Zero();  ///< alpha with the antenna's turning about the IMU
    Vector3 v_n = Vector3::Zero();   ///< m/s
    Vector3 variance = Vector3::Zero();
  };

  void begin(std::int64_t time_ns);
  void integrate(const ImuSample& sample);
  void take_waiting_fixes();
  std::optional<Integrals> at(std::int64_t time_ns) const;
  double change_of_velocity_m_per_s() const;
  Matrix3 first_attitude() const;
  void solve();
  double elapsed_s(std::int64_t time_ns) const { return time::to_seconds(time_ns - start_ns_); }

  NavigationParameters parameters_;
  nav::Gravity gravity_;
  double longest_s_;
  std::optional<GnssFix> newest_fix_;
  std::deque<GnssFix> waiting_;
  std::deque<Integrals> past_;  ///< the newest last; as far back as a fix may be late
  std::vector<Match> matches_;
  std::int64_t start_ns_ = 0;
  std::optional<Result> result_;
  std::string why_not_ = "no fix with a velocity has come";
};

}  // namespace inslab::navigation
