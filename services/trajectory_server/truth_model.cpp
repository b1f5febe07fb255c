#include "services/trajectory_server/truth_model.hpp"

#include "config/error.hpp"
#include "services/trajectory_server/live_vehicle_model.hpp"
#include "services/trajectory_server/motion_table_model.hpp"

namespace inslab::trajectory {

std::unique_ptr<TruthModel> make_truth_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::Trajectory& trajectory = scenario.scenario.trajectory;
  switch (trajectory.source) {
    case scenario::TrajectorySource::VehicleState:
      return std::make_unique<LiveVehicleModel>(trajectory, scenario.truth_rate, start);
    case scenario::TrajectorySource::MotionTable:
      break;
    case scenario::TrajectorySource::File:
      throw config::Error(scenario.file.string(),
                          {Rule::MethodNeeds, "trajectory.file.method",
                           "is " + std::string(enum_name(trajectory.file.method)) + ", which is not built in"});
  }
  return std::make_unique<MotionTableModel>(trajectory, scenario.truth_rate, start);
}

}  // namespace inslab::trajectory
