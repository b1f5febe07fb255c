#pragma once

#include <optional>

#include "inslab/models/trajectory/attitude_law.hpp"
#include "inslab/models/trajectory/smooth_motion.hpp"

namespace inslab::trajectory {

/// Words for where the nose would have to jump.
struct JumpWords {
  const char* place;   ///< what the pieces of the path lead from: waypoint, row
  const char* remedy;  ///< what to do, after "expected"
};

/// A rotation spline through the attitudes that a law asks for along a path, at instants as near to each other as the
/// law needs. `end` is the last instant that is asked for, if that comes before the path's end: what lies further than
/// the reach of a spline beyond it is left out. Throws std::domain_error, naming time and place, where the nose would
/// have to jump.
std::unique_ptr<const AttitudeCurve> sampled_attitude(const Path& path, AttitudeLaw& law, const JumpWords& words,
                                                      std::optional<time::Nanoseconds> end = std::nullopt);

}  // namespace inslab::trajectory
