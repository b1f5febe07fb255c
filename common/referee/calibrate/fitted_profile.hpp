#pragma once

#include <string>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/referee/calibrate/analysis.hpp"

namespace inslab::calibrate {

/// A fitted parameter's name, unit and size in the terms of a profile.
struct ProfileUnit {
  const char* key;   ///< of GyroErrors or AccelErrors
  const char* unit;  ///< for people
  double si;         ///< one of it in SI
};

ProfileUnit profile_unit(allan::Parameter parameter, bool is_gyro);

/// The twin of the recorded IMU: each axis with the parameters fitted to it, white noise as angle or velocity random
/// walk, flicker as bias instability, quantization Q as a count of Q sqrt(12) (a count's error is even over its width).
/// The mean is a bias only where the truth was taken off; elsewhere Earth rate and gravity are in it and it is left
/// out. A source that is a poor fit says so. Throws std::runtime_error naming the parameter when the fit lies outside
/// what a profile may say.
ImuErrorProfile fitted_profile(const ImuAnalysis& analysis);

}  // namespace inslab::calibrate
