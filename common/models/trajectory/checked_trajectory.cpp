#include "inslab/models/trajectory/checked_trajectory.hpp"

#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::trajectory {

const scenario::Trajectory& checked(const scenario::Trajectory& trajectory) {
  if (const auto broken = scenario::violation(trajectory)) {
    throw std::invalid_argument("trajectory." + broken->path + " " + broken->reason);
  }
  nav::check_domain({trajectory.initial.latitude_deg * units::kDeg, trajectory.initial.longitude_deg * units::kDeg,
                     trajectory.initial.height_m});
  return trajectory;
}

}  // namespace inslab::trajectory
