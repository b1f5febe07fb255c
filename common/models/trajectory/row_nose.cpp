#include "inslab/models/trajectory/row_nose.hpp"

#include <cmath>

#include "inslab/models/trajectory/vehicle_attitude.hpp"

namespace inslab::trajectory {

RowNose::RowNose(const std::vector<PathMotion>& motions, const scenario::VehicleAttitude& options)
    : directions_(attitudes_along(motions, options)) {
  moves_.reserve(motions.size());
  for (const PathMotion& motion : motions) moves_.push_back(is_moving(motion, options));
}

nav::Vector3 RowNose::along_n(const scenario::PathPiece& piece, double t_s, const nav::Vector3& v_n) const {
  if (moves_[piece.index] && moves_[piece.index + 1]) return v_n;
  const nav::RollPitchYaw &from = directions_[piece.index], &to = directions_[piece.index + 1];
  const double share = smooth_step(t_s / time::to_seconds(piece.end - piece.start));
  const double yaw_rad = from.yaw_rad + share * nav::wrapped_to_pi(to.yaw_rad - from.yaw_rad);
  const double pitch_rad = from.pitch_rad + share * (to.pitch_rad - from.pitch_rad);
  return nav::matrix_from_rpy({0.0, pitch_rad, yaw_rad}).col(0);
}

}  // namespace inslab::trajectory
