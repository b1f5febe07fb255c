#pragma once

#include "inslab/models/trajectory/attitude_law.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"

namespace inslab::trajectory {

/// Words for where the nose would have to jump.
struct JumpWords {
  const char* place;   ///< what the pieces of the path lead from: waypoint, row
  const char* remedy;  ///< what to do, after "expected"
};

/// A rotation spline through the attitudes that a law asks for along a path, at instants as near to each other as the
/// law needs. Throws std::domain_error, naming time and place, where the nose would have to jump.
std::unique_ptr<const AttitudeCurve> sampled_attitude(const Path& path, AttitudeLaw& law, const JumpWords& words);

}  // namespace inslab::trajectory
