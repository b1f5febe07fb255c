#include "inslab/models/trajectory/truth_model.hpp"

#include <stdexcept>

#include "inslab/data/json/config_error.hpp"
#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/models/trajectory/live_vehicle_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/models/trajectory/waypoint_motion.hpp"

namespace inslab::trajectory {

namespace {

std::unique_ptr<TruthModel> make_file_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::FileMotion& motion = scenario.scenario.trajectory.file;
  if (motion.method == scenario::FileMethod::InverseMechanization) {
    return std::make_unique<InverseMechanizationModel>(
        scenario.trajectory_file, scenario.gravity(),
        InverseMechanizationModel::Options{motion.position_feedback_per_s, {motion.full_rotation_term}},
        scenario.truth_grid(), start);
  }
  try {
    return std::make_unique<SmoothModel>(
        motion_through(*scenario.trajectory_file, motion.attitude_from_path, scenario.gravity()), "row",
        scenario.gravity(), scenario.truth_grid(), start);
  } catch (const std::domain_error& error) {
    const bool has_attitude = scenario.trajectory_file->rows.front().rpy.has_value();
    throw json::Error(scenario.file.string(),
                      {Rule::MethodNeeds,
                       has_attitude ? "trajectory.file.method" : "trajectory.file.attitude_from_path", error.what()});
  }
}

std::unique_ptr<TruthModel> make_waypoint_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const time::Nanoseconds end = scenario.truth_grid().at(scenario.truth_samples);
  try {
    return std::make_unique<SmoothModel>(motion_along_waypoints(scenario.scenario.trajectory, end, scenario.gravity()),
                                         "waypoint", scenario.gravity(), scenario.truth_grid(), start);
  } catch (const std::domain_error& error) {
    throw json::Error(scenario.file.string(), {Rule::WaypointTurn, "trajectory.waypoints", error.what()});
  }
}

}  // namespace

std::unique_ptr<TruthModel> make_truth_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::Trajectory& trajectory = scenario.scenario.trajectory;
  switch (trajectory.source) {
    case scenario::TrajectorySource::VehicleState:
      return std::make_unique<LiveVehicleModel>(trajectory, scenario.gravity(), scenario.truth_grid(), start);
    case scenario::TrajectorySource::MotionTable:
      break;
    case scenario::TrajectorySource::File:
      return make_file_model(scenario, start);
    case scenario::TrajectorySource::Waypoints:
      return make_waypoint_model(scenario, start);
  }
  try {
    return std::make_unique<MotionTableModel>(trajectory, scenario.gravity(), scenario.truth_grid(), start);
  } catch (const std::domain_error& error) {
    throw json::Error(scenario.file.string(), {Rule::ValueRange, "trajectory", error.what()});
  }
}

}  // namespace inslab::trajectory
