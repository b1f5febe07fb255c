#pragma once

#include <Eigen/Core>

#include "nav/gravity.hpp"
#include "samples/imu_error_profile.hpp"
#include "samples/truth_state.hpp"

/// What errors an IMU's data sheet lets one expect of free inertial navigation along a known motion.
namespace inslab::predict {

using nav::Vector3;

/// Root mean squares of an estimate's errors in n; at the start what is known of them.
struct PredictedError {
  double time_s = 0.0;
  Vector3 position_n_m = Vector3::Zero();
  Vector3 velocity_n_m_per_s = Vector3::Zero();
  Vector3 attitude_n_rad = Vector3::Zero();  ///< the phi angle
};

/// Whether the height is part of the game, or held to the truth as by a perfect barometer.
enum class Vertical { Free, Held };

/// The nine-state model (nav/error_model.hpp) along the truth, with the sensor errors of a profile as further states:
/// for each axis of both triads a constant bias that may walk, a Gauss-Markov bias, a constant scale factor and a
/// Gauss-Markov one, and white noise beside them.
///
/// Fixed values of a profile count with their square, as do turn-on sigmas; bias instability counts as a constant of
/// its size. Temperature, cross axes, nonlinearity, g-sensitivity, bandwidth, quantization and the installation are
/// left out: the IMU is at the vehicle's reference point in its axes. Linear: meant for errors that are small beside
/// the Earth's radius and a radian.
class ErrorGrowth {
 public:
  /// `step_s`: the covariance goes on in steps of this length or of one sample, whichever is longer; the motion in
  /// between counts with its mean. Throws std::invalid_argument when it is not positive.
  ErrorGrowth(const ImuErrorProfile& profile, const PredictedError& start, const nav::Gravity& gravity,
              Vertical vertical, double step_s);

  /// The truth goes on by the interval that ends at `truth`; true when a step was made and current() is new.
  bool advance(const TruthState& truth);

  /// At the end of the last step.
  PredictedError current() const;

 private:
  static constexpr int kStates = 33;
  using Matrix = Eigen::Matrix<double, kStates, kStates>;
  using Vector = Eigen::Matrix<double, kStates, 1>;

  void step(const TruthState& truth);
  void hold_vertical();

  nav::Gravity gravity_;
  Vertical vertical_;
  double step_s_;
  double time_s_ = 0.0;
  double gathered_s_ = 0.0;
  Vector3 dtheta_b_ = Vector3::Zero();  ///< since the last step, rad
  Vector3 dv_b_ = Vector3::Zero();      ///< the same, m/s
  Vector3 gyro_density_;                ///< rad^2/s
  Vector3 accel_density_;               ///< (m/s)^2/s
  Vector decay_per_s_ = Vector::Zero();
  Vector drive_ = Vector::Zero();  ///< spectral density of each state's own white drive
  Matrix P_ = Matrix::Zero();
};

}  // namespace inslab::predict
