#pragma once

#include <Eigen/Core>

namespace inslab::reference_nav {

/// Where each error stands in the state of 21: three of each, the estimate less the truth.
enum StateIndex : Eigen::Index {
  kPosition = 0,    ///< m, north east down
  kVelocity = 3,    ///< m/s, n
  kAttitude = 6,    ///< phi, rad, n: the computed C_nb is (I - [phi x]) C_nb
  kGyroBias = 9,    ///< rad/s, b
  kAccelBias = 12,  ///< m/s^2, b
  kGyroScale = 15,  ///< 1, b
  kAccelScale = 18,
};
inline constexpr Eigen::Index kStates = 21;
inline constexpr Eigen::Index kNavStates = 9;
inline constexpr Eigen::Index kSensorStates = 12;

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Matrix9x12 = Eigen::Matrix<double, 9, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Vector21 = Eigen::Matrix<double, 21, 1>;
using Matrix21 = Eigen::Matrix<double, 21, 21>;

/// How errors go on over a step: nav' = nav_by_nav nav + nav_by_sensor sensor, sensor' = sensor_decay sensor, and the
/// variance that comes in. The sensor errors are Gauss-Markov, each for itself, so theirs is a diagonal.
struct Transition {
  Matrix9 nav_by_nav;
  Matrix9x12 nav_by_sensor;
  Vector12 sensor_decay;
  Eigen::Matrix3d velocity_noise;  ///< (m/s)^2, n
  Eigen::Matrix3d attitude_noise;  ///< rad^2, n
  Vector12 sensor_noise;           ///< variances
};

/// The covariance of the 21 errors. Symmetric to the bit after every function.
class Covariance {
 public:
  explicit Covariance(const Vector21& sigmas) : P_(sigmas.cwiseAbs2().asDiagonal()) {}
  /// Of errors that know of each other; made symmetric.
  static Covariance of(const Matrix21& matrix) {
    Covariance covariance(Vector21::Zero());
    covariance.P_ = 0.5 * (matrix + matrix.transpose());
    return covariance;
  }

  const Matrix21& matrix() const { return P_; }

  /// P <- Phi (P + Q/2) Phi^T + Q/2: half the noise comes in at the step's beginning, half at its end.
  void propagate(const Transition& transition);

  /// One scalar measurement of variance `variance` whose error is `h` times the state: corrects `x` by the
  /// `innovation` (predicted less measured, before any correction in x) and P. Several uncorrelated measurements, one
  /// after the other, give what all at once would.
  void update(const Vector21& h, double variance, double innovation, Vector21& x);

  /// Adds a variance to three errors that were not in the model.
  void add(StateIndex first, const Eigen::Matrix3d& variance) { P_.block<3, 3>(first, first) += variance; }

  /// Forgets what is known of three errors and gives them new, uncorrelated variances.
  void forget(StateIndex first, const Eigen::Vector3d& variances);

 private:
  Matrix21 P_;
};

}  // namespace inslab::reference_nav
