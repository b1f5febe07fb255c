#pragma once

#include "inslab/referee/graft/reference_imu.hpp"

namespace inslab::graft {

/// How a recorded IMU lies on a reference, by least squares, with the standard deviation of each value as far as white
/// residuals give it.
struct GeometryFit {
  Geometry geometry;
  Geometry sigma;
  int iterations = 0;
};

/// Fits time offset, mounting and lever arm together with a constant bias and a scale factor of each axis, which
/// would bend them otherwise, by Gauss-Newton with numerical derivatives, beginning with `start`. `measured` are the
/// intervals that `reference` covers. A value that the motion says nothing of keeps what it began with, with the
/// sigma of what is known beforehand: 1 s, 0.3 rad, 10 m. Throws std::runtime_error when it does not settle within 20
/// iterations.
GeometryFit fit_geometry(const ReferenceImu& reference, const std::vector<RecordedErrors::Increments>& measured,
                         const Geometry& start);

}  // namespace inslab::graft
