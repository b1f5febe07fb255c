#pragma once

#include "inslab/models/trajectory/vehicle_motion.hpp"

namespace inslab::trajectory {

/// When a vehicle at the start of a ballistic segment is back at the height it has now: the last whole nanosecond at
/// which it is not below. `at_most` when it does not rise, leaves the valid domain, or takes longer. Throws
/// std::domain_error as VehicleMotion::step() does.
time::Nanoseconds time_back_at_start_height(VehicleMotion vehicle, time::Nanoseconds at_most);

}  // namespace inslab::trajectory
