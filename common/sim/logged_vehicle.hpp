#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/vehicle_state.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::sim {

/// The states that a logged run of a live vehicle used, in their order: with them it can be repeated. Throws
/// files::ReadError, also when the log has none or some of them are missing.
std::vector<UsedVehicleState> logged_vehicle_states(const std::string& log_path);

/// What stands for the simulator that a live vehicle's scenario needs; nothing for another one. Throws
/// host::UsageError when `vehicle_log` is not given, or given and not needed.
std::vector<UsedVehicleState> vehicle_states_for(const scenario::LoadedScenario& loaded,
                                                 const std::string& vehicle_log);

}  // namespace inslab::sim
