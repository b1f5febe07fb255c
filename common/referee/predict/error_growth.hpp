#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/gravity_along_way.hpp"
#include "inslab/referee/predict/sensor_terms.hpp"

/// What errors an IMU's data sheet lets one expect of inertial navigation along a known motion.
namespace inslab::predict {

/// Root mean squares of an estimate's errors in n; at the start what is known of them.
struct PredictedError {
  double time_s = 0.0;
  Vector3 position_n_m = Vector3::Zero();
  Vector3 velocity_n_m_per_s = Vector3::Zero();
  Vector3 attitude_n_rad = Vector3::Zero();  ///< the phi angle
};

/// What the app is not told of gravity.
struct GravityErrors {
  nav::GravityAlongWay along_way;
  /// The attitude at the start errs, besides what is known of it, as the plumb line there leans.
  bool starts_on_plumb_line = false;
};

/// Whether the height is part of the game, or held to the truth as by a perfect barometer.
enum class Vertical { Free, Held };

/// The nine-state model (nav/error_model.hpp) along the IMU's true motion, with a state for each term of its profile
/// (sensor_terms.hpp), six Gauss-Markov states for a receiver's slow errors, six for gravity's departure from its model
/// where there is one, and white noise beside them: the covariance of the best linear estimate. Without fixes it is
/// that of free inertial navigation.
///
/// Linear: meant for errors that are small beside the Earth's radius and a radian.
class ErrorGrowth {
 public:
  /// `step_s`: the covariance goes on in steps of this length or of one sample, whichever is longer; the motion in
  /// between counts with its means. Throws std::invalid_argument when it is not positive.
  ErrorGrowth(const ImuErrorProfile& profile, const PredictedError& start, const nav::Gravity& gravity,
              Vertical vertical, double step_s, const std::optional<GravityErrors>& gravity_errors = std::nullopt);

  /// Another profile from the next interval on. States keep, lose or redraw their value as its `continuity` says of
  /// theirs (imu::Bias::retune); a fixed value that changes is unknown anew.
  void swap(const ImuErrorProfile& profile);

  /// The IMU goes on by the interval that ends at `truth`, at a temperature above that of calibration that rises by
  /// `warming_k_per_s`; true when a step was made and current() is new.
  bool advance(const ImuTruth& truth, double warmer_k, double warming_k_per_s);

  /// A fix at the end of the last interval: `lever_arm_b_m` leads from the IMU to the antenna and is known. A velocity
  /// without errors is none.
  void measure(const SolutionErrors& fix, const Vector3& lever_arm_b_m);

  /// At the end of the last step or fix.
  PredictedError current() const;

 private:
  /// The motion since the last step: integrals.
  struct Gathered {
    double time_s = 0.0;
    double warmer_k = 0.0;
    double warmed_k = 0.0;
    nav::Matrix3 C_nb = nav::Matrix3::Zero();
    Vector3 dv_n = Vector3::Zero();
    SensedMeans gyro;
    SensedMeans accel;
  };
  /// How the states but the nine go on in a step, and what drives them.
  struct Steps {
    Eigen::VectorXd decay, integral, drive, drive_with_integral, drive_of_integral;
  };

  void step();
  Steps steps_of(double dt_s) const;
  Eigen::MatrixXd effects(const SensedMotion& motion, const nav::Matrix3& C_nb, const nav::WayStep& way) const;
  void begin_on_plumb_line(double gravity_m_per_s2);
  void set_density(const ImuErrorProfile& profile);
  void renew(Eigen::Index state, double variance);
  void update(const Eigen::VectorXd& row, double variance);
  void hold_vertical();

  nav::Gravity gravity_;
  Vertical vertical_;
  double step_s_;
  double time_s_ = 0.0;
  Gathered gathered_;
  ImuTruth last_;
  Vector3 gyro_density_;   ///< rad^2/s
  Vector3 accel_density_;  ///< (m/s)^2/s
  std::optional<nav::GravityAlongWay> along_way_;
  Eigen::Index first_term_;
  std::vector<SensorTerm> terms_;  ///< state first_term_ + i
  Vector3 fix_times_s_[2];         ///< correlation times of a receiver's position and velocity errors
  Eigen::MatrixXd P_;
};

}  // namespace inslab::predict
