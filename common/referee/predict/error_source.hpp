#pragma once

#include <string>

#include "inslab/nav/vectors.hpp"

namespace inslab::predict {

enum class SourceKind { Position, Velocity, Phi, AccelBias, GyroBias };

/// One constant error: of the start (position, velocity, phi angle), or of a sensor all along.
struct ErrorSource {
  std::string text;  ///< as it was asked for
  SourceKind kind = SourceKind::Position;
  int axis = 0;          ///< north, east, down, or x, y, z
  bool in_body = false;  ///< a bias along an axis of b, not of n
  double value = 0.0;    ///< SI, with its sign; the estimate or measurement less the truth
};

/// NAME_AXIS=VALUE UNIT, such as "gyro_bias_e=0.01deg/h" or "velocity_n=0.1 m/s": position, velocity, phi along n, e,
/// d; accel_bias, gyro_bias along n, e, d or x, y, z. Throws std::invalid_argument naming what is wrong and what there
/// is.
ErrorSource error_source(const std::string& text);

/// Constant errors in n, SI.
struct ConstantErrors {
  nav::Vector3 position_n = nav::Vector3::Zero();
  nav::Vector3 velocity_n = nav::Vector3::Zero();
  nav::Vector3 phi_n = nav::Vector3::Zero();
  nav::Vector3 accel_n = nav::Vector3::Zero();
  nav::Vector3 gyro_n = nav::Vector3::Zero();
};

/// A source in an attitude.
ConstantErrors constant_errors(const ErrorSource& source, const nav::Matrix3& C_nb);

}  // namespace inslab::predict
