#pragma once

#include <vector>

#include "inslab/models/trajectory/path_attitude.hpp"
#include "inslab/scenario/path_piece.hpp"

namespace inslab::trajectory {

/// Which way a path through the rows of a file points, at rest too, where its velocity says nothing.
///
/// Between two rows that move it is the direction of the velocity. Where one of them stands still, below
/// standstill_speed_m_per_s, yaw and pitch go from those of the one to those of the other, the shorter way and with no
/// rate at either end; a row at standstill has those of the last one that moved, or of the first that will.
class RowNose {
 public:
  /// Motions at all rows.
  RowNose(const std::vector<PathMotion>& motions, const scenario::VehicleAttitude& options);

  /// At a time since the piece's start; `v_n` is the velocity there.
  nav::Vector3 along_n(const scenario::PathPiece& piece, double t_s, const nav::Vector3& v_n) const;

 private:
  std::vector<nav::RollPitchYaw> directions_;
  std::vector<bool> moves_;
};

}  // namespace inslab::trajectory
