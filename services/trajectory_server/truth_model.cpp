#include "services/trajectory_server/truth_model.hpp"

#include "config/error.hpp"
#include "services/trajectory_server/inverse_mechanization_model.hpp"
#include "services/trajectory_server/live_vehicle_model.hpp"
#include "services/trajectory_server/motion_table_model.hpp"

namespace inslab::trajectory {

namespace {

std::unique_ptr<TruthModel> make_file_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::FileMotion& motion = scenario.scenario.trajectory.file;
  if (motion.method == scenario::FileMethod::InverseMechanization) {
    return std::make_unique<InverseMechanizationModel>(
        scenario.trajectory_file, scenario.gravity(),
        InverseMechanizationModel::Options{motion.position_feedback_per_s, {motion.full_rotation_term}},
        scenario.truth_rate, start);
  }
  throw config::Error(scenario.file.string(),
                      {Rule::MethodNeeds, "trajectory.file.method",
                       "is " + std::string(enum_name(motion.method)) + ", which is not built in"});
}

}  // namespace

std::unique_ptr<TruthModel> make_truth_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::Trajectory& trajectory = scenario.scenario.trajectory;
  switch (trajectory.source) {
    case scenario::TrajectorySource::VehicleState:
      return std::make_unique<LiveVehicleModel>(trajectory, scenario.truth_rate, start);
    case scenario::TrajectorySource::MotionTable:
      break;
    case scenario::TrajectorySource::File:
      return make_file_model(scenario, start);
  }
  return std::make_unique<MotionTableModel>(trajectory, scenario.truth_rate, start);
}

}  // namespace inslab::trajectory
