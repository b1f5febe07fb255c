#include "services/trajectory_server/truth_model.hpp"

#include "services/trajectory_server/motion_table_model.hpp"

namespace inslab::trajectory {

std::unique_ptr<TruthModel> make_truth_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start) {
  const scenario::Trajectory& trajectory = scenario.scenario.trajectory;
  switch (trajectory.source) {
    case scenario::TrajectorySource::MotionTable:
      break;
  }
  return std::make_unique<MotionTableModel>(trajectory, scenario.truth_rate, start);
}

}  // namespace inslab::trajectory
