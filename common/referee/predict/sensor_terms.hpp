#pragma once

#include <limits>
#include <string>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"

namespace inslab::predict {

enum class Triad { Gyro, Accel };

/// The terms of a profile that have a state each, axis by axis (cross-axis: angle by angle, g-sensitivity: entry by
/// entry, flicker: process by process).
enum class TermKind {
  BiasConstant,
  BiasTurnOn,
  BiasGaussMarkov,
  BiasRandomWalk,
  BiasFlicker,
  BiasTemperature,
  BiasTemperatureRate,
  ScaleConstant,
  ScaleTurnOn,
  ScaleGaussMarkov,
  ScaleTemperature,
  Asymmetry,
  Cube,
  Square,
  CrossAxis,
  CrossAxisGaussMarkov,
  GSensitivity,
  GSquare,
  GProduct,
  RateProduct,
};

/// One error source of a triad as a state of unit variance: error in b (rad/s | m/s^2) = state * effect of the motion.
struct SensorTerm {
  Triad triad = Triad::Gyro;
  TermKind kind = TermKind::BiasConstant;
  int index = 0;                                                        ///< among those of its kind and triad
  double amplitude = 0.0;                                               ///< SI; fixed values with their sign
  double correlation_time_s = std::numeric_limits<double>::infinity();  ///< infinite: a constant, or a walk

  bool is_of(const SensorTerm& other) const {
    return triad == other.triad && kind == other.kind && index == other.index;
  }
};

/// The terms of a profile that are not zero.
///
/// Flicker is the sum of Gauss-Markov processes that noise/random/flicker.hpp makes of it at 1 Hz: an error of
/// navigation integrates the faster ones away. Temperature, cross-axis,
/// asymmetry, non-linearity and g-sensitivity are linear in their coefficient along a known motion; a fixed value
/// counts as a constant of unknown sign and of that size.
std::vector<SensorTerm> terms_of(const ImuErrorProfile& profile);

/// Means over a stretch of what one triad senses, in b: rad/s | m/s^2 and powers of it.
struct SensedMeans {
  Vector3 x = Vector3::Zero();
  Vector3 abs = Vector3::Zero();
  Vector3 square = Vector3::Zero();
  Vector3 cube = Vector3::Zero();
  Vector3 product = Vector3::Zero();  ///< y z, z x, x y
};

/// What both triads sense; `warmer_k`: above the temperature of calibration, `warming_k_per_s`: how fast it rises.
struct SensedMotion {
  SensedMeans gyro;
  SensedMeans accel;
  double warmer_k = 0.0;
  double warming_k_per_s = 0.0;
};

/// The error in b, rad/s | m/s^2, of a state of 1.
Vector3 effect(const SensorTerm& term, const SensedMotion& motion);

}  // namespace inslab::predict
