#include "inslab/sim/logged_vehicle.hpp"

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/usage_error.hpp"

namespace inslab::sim {

std::vector<UsedVehicleState> logged_vehicle_states(const std::string& log_path) {
  const mcap::McapReader log(log_path);
  std::vector<UsedVehicleState> states;
  log.for_each([&](const mcap::Message& message) {
    if (log.channels().at(message.channel_id).topic != catalog::kVehicleStateUsed.name) return true;
    UsedVehicleState state;
    if (wire::decode(message.data, message.size, state)) states.push_back(state);
    return true;
  });
  std::sort(states.begin(), states.end(), [](const UsedVehicleState& a, const UsedVehicleState& b) {
    return a.header.sequence_number < b.header.sequence_number;
  });
  const std::string topic = catalog::kVehicleStateUsed.name;
  if (states.empty()) throw files::ReadError(log_path + ": has no " + topic + ": no run of a live vehicle");
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].header.sequence_number == i) continue;
    throw files::ReadError(log_path + ": " + topic + ": number " + std::to_string(i) +
                           " is missing, so the run cannot be repeated");
  }
  return states;
}

std::vector<UsedVehicleState> vehicle_states_for(const scenario::LoadedScenario& loaded,
                                                 const std::string& vehicle_log) {
  const bool is_live = loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState;
  if (is_live == !vehicle_log.empty()) {
    return is_live ? logged_vehicle_states(vehicle_log) : std::vector<UsedVehicleState>{};
  }
  throw host::UsageError(
      loaded.file.string() + ": trajectory.source " +
      (is_live ? "is vehicle_state: to repeat a live run give its log, --vehicle LOG; otherwise it needs inslab run"
               : "is not vehicle_state; --vehicle is for scenarios that follow a live vehicle"));
}

}  // namespace inslab::sim
