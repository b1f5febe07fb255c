#pragma once

#include "inslab/scenario/trajectory.hpp"

namespace inslab::trajectory {

/// The same trajectory. Throws std::invalid_argument, naming the path, when it breaks a rule, and std::domain_error
/// when it begins where no navigation frame is defined.
const scenario::Trajectory& checked(const scenario::Trajectory& trajectory);

}  // namespace inslab::trajectory
