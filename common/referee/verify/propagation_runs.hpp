#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/strapdown.hpp"
#include "inslab/referee/predict/error_growth.hpp"
#include "inslab/referee/verify/subjects.hpp"

/// Pure inertial navigation at rest through the whole chain: truth model, IMU model, mechanization.
namespace inslab::verify {

/// (delta r_n, delta v_n, phi) of nav/error_model.hpp: m, m/s, rad; the estimate less the truth.
using ErrorState = Eigen::Matrix<double, 9, 1>;

/// A vehicle at rest, level, looking north, at 30 deg latitude and on the ellipsoid, with an IMU of 10 Hz: at rest the
/// rate only matters to noise, which scales with it.
struct RestingRun {
  ImuErrorProfile errors;
  ErrorState start = ErrorState::Zero();  ///< the navigation app's errors when it begins
  predict::Vertical vertical = predict::Vertical::Held;
  std::uint64_t seed = 1;
  int duration_s = 3600;
};

inline constexpr double kRestingRateHz = 10.0;
nav::Geodetic resting_place();

/// The errors at 0, `every_s`, 2 `every_s`, ... s.
std::vector<ErrorState> navigate_at_rest(const RestingRun& run, int every_s, const Subjects& subjects = {});

/// The same by the linear model under constant sensor errors in n (rad/s, m/s^2): Runge-Kutta of fourth order with
/// steps of a second. Held: without its vertical states.
std::vector<ErrorState> propagate_linearly(const ErrorState& start, const nav::Vector3& gyro_error_n,
                                           const nav::Vector3& accel_error_n, predict::Vertical vertical,
                                           int duration_s, int every_s);

/// What is to be expected of such runs at their end.
predict::PredictedError predict_at_rest(const RestingRun& run);

}  // namespace inslab::verify
