#pragma once

#include <vector>

#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::graft {

/// What of an IMU's errors goes with the motion, by regression on it; as the model of an IMU has it (docs/models.md):
/// errors = (S + N) input + G f + K f^2, beside a constant that stays with the signal.
struct MotionTerms {
  nav::Matrix3 gyro = nav::Matrix3::Zero();             ///< scale factors and, beside the diagonal, cross-axis angles
  nav::Matrix3 accel = nav::Matrix3::Zero();            ///< the same
  nav::Matrix3 g_sensitivity = nav::Matrix3::Zero();    ///< rad/s per m/s^2
  nav::Vector3 accel_square = nav::Vector3::Zero();     ///< 1/(m/s^2), of the axis' own force
  nav::Vector3 gyro_explained = nav::Vector3::Zero();   ///< share of the variance of each axis that they explain
  nav::Vector3 accel_explained = nav::Vector3::Zero();  ///< the same
};

/// The terms of `errors`, interval by interval beside the perfect increments.
MotionTerms fit_motion_terms(const std::vector<RecordedErrors::Increments>& errors,
                             const std::vector<RecordedErrors::Increments>& perfect, double dt_s);

/// The errors that they make of an interval.
RecordedErrors::Increments motion_errors(const MotionTerms& terms, const RecordedErrors::Increments& perfect,
                                         double dt_s);

}  // namespace inslab::graft
