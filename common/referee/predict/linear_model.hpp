#pragma once

#include <optional>

#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/nav/error_model.hpp"
#include "inslab/referee/predict/error_growth.hpp"

namespace inslab::predict {

/// delta r_n, delta v_n, phi: m, m/s, rad; the estimate less the truth.
using ErrorState = Eigen::Matrix<double, 9, 1>;

/// The nine-state model x' = F x + u (nav/error_model.hpp) over one step: x goes on to Phi x + Phi_u u for a constant
/// u.
struct LinearStep {
  double end_s = 0.0;
  double dt_s = 0.0;
  nav::Geodetic position;                        ///< at the step's end
  Vector3 v_n = Vector3::Zero();                 ///< the same
  Vector3 f_n = Vector3::Zero();                 ///< mean of the step, m/s^2
  nav::Matrix3 C_nb = nav::Matrix3::Identity();  ///< the same
  nav::Matrix9 F = nav::Matrix9::Zero();
  nav::Matrix9 Phi = nav::Matrix9::Identity();  ///< exp(F dt)
  nav::Matrix9 Phi_u = nav::Matrix9::Zero();    ///< integral of exp(F s) over the step, s
};

/// A level IMU at rest that looks north. Held: without the vertical states.
LinearStep resting_step(const nav::Geodetic& place, const nav::Gravity& gravity, Vertical vertical, double dt_s);

/// The steps of a motion: each of this length, or of one sample where that is longer.
class LinearMotion {
 public:
  /// Throws std::invalid_argument when `step_s` is not positive.
  LinearMotion(const nav::Gravity& gravity, Vertical vertical, double step_s);

  /// The IMU goes on by the interval that ends at `truth`; a step when one has come to its end.
  std::optional<LinearStep> advance(const ImuTruth& truth);

 private:
  nav::Gravity gravity_;
  Vertical vertical_;
  double step_s_;
  double time_s_ = 0.0;  ///< gathered so far
  nav::Matrix3 C_nb_sum_ = nav::Matrix3::Zero();
  Vector3 dv_n_ = Vector3::Zero();
};

}  // namespace inslab::predict
