#include "inslab/referee/verify/subjects.hpp"

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/referee/verify/run_start.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::verify {

std::unique_ptr<trajectory::TruthModel> product_truth(const scenario::Trajectory& trajectory, const time::Rate& rate) {
  return std::make_unique<trajectory::MotionTableModel>(trajectory, rate, kStart);
}

std::unique_ptr<trajectory::TruthModel> product_inverse(const std::shared_ptr<const TrajectoryFile>& file,
                                                        const nav::Gravity& gravity, const time::Rate& rate) {
  return std::make_unique<trajectory::InverseMechanizationModel>(
      file, gravity, trajectory::InverseMechanizationModel::Options{}, rate, kStart);
}

trajectory::SmoothMotion product_curve(const TrajectoryFile& file) { return trajectory::motion_through(file, {}); }

Imu product_imu(const imu::ImuModel::Setup& setup) {
  auto model = std::make_shared<imu::ImuModel>(setup);
  return [model](const TruthState& truth) { return model->measure(truth); };
}

ImuLines product_lines() {
  constexpr std::uint32_t kIsa100c = 26;
  auto format = std::make_shared<novatel::NovatelImuFormatter>(kIsa100c, novatel::NovatelAxes::RightForwardUp);
  return [format](const ImuSample& sample) {
    return format->line({sample.header.gps_week, sample.header.gps_time_of_week_ns}, sample.dtheta_b, sample.dv_b);
  };
}

void product_simulation(const scenario::LoadedScenario& scenario, const time::GpsTime& start, sim::RunSink& sink) {
  sim::OfflineRun run(scenario, start, RunId{}, sink);
  while (run.step()) continue;
}

}  // namespace inslab::verify
