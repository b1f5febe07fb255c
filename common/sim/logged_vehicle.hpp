#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/vehicle_state.hpp"

namespace inslab::cli {

/// The states that a logged run of a live vehicle used, in their order: with them it can be repeated. Throws
/// io::ReadError, also when the log has none or some of them are missing.
std::vector<UsedVehicleState> logged_vehicle_states(const std::string& log_path);

}  // namespace inslab::cli
