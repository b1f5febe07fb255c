#include "inslab/referee/verify/loop.hpp"

#include <algorithm>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/referee/verify/run_start.hpp"
#include "inslab/referee/verify/written_rows.hpp"

namespace inslab::verify {

namespace {

void write(WrittenRows& rows, const TruthState& truth) {
  TrajectoryRow row;
  row.position = {truth.latitude_rad, truth.longitude_rad, truth.height_m};
  row.v_n = truth.v_n;
  row.rpy = nav::rpy_from_quaternion(truth.q_nv);
  rows.add({truth.header.gps_week, truth.header.gps_time_of_week_ns}, row);
}

imu::ImuModel perfect_imu(const nav::Gravity& gravity, const time::Rate& rate) {
  return imu::ImuModel({0, 0, rate, gravity, ImuErrorProfile{}, VibrationProfile{}, InstallationProfile{}});
}

}  // namespace

std::shared_ptr<const TrajectoryFile> rows_as_written(const scenario::Trajectory& trajectory, const std::string& name,
                                                      const time::Rate& rate, time::Nanoseconds duration) {
  WrittenRows written(name);
  trajectory::MotionTableModel model(trajectory, rate, kStart);
  TruthState truth = model.current();
  write(written, truth);
  while (time::Nanoseconds(truth.header.sim_time_ns) + rate.period() <= std::min(duration, model.end())) {
    write(written, truth = model.advance());
  }
  return written.read();
}

DeviationFigures close_loop(trajectory::TruthModel& truth, const nav::Gravity& gravity,
                            const nav::Strapdown::Options& options, const time::Rate& rate, std::uint64_t steps,
                            const std::function<nav::NavState(const TruthState&)>& expected) {
  imu::ImuModel imu = perfect_imu(gravity, rate);
  imu.measure(truth.current());
  nav::Strapdown strapdown(nav_state(truth.current()), gravity, options);
  Deviation deviation(steps);
  for (std::uint64_t k = 0; k < steps; ++k) {
    const TruthState now = truth.advance();
    const ImuSample sample = imu.measure(now)->sample;
    strapdown.advance({sample.dtheta_b, sample.dv_b, rate.period_s()});
    deviation.add(strapdown.state(), expected(now));
  }
  return deviation.figures();
}

DeviationFigures close_file_loop(const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity,
                                 const time::Rate& rate) {
  trajectory::InverseMechanizationModel truth(file, gravity, {}, rate, kStart);
  trajectory::FileStates rows(file);
  const auto steps = static_cast<std::uint64_t>(truth.end() / rate.period());
  return close_loop(truth, gravity, {}, rate, steps,
                    [&rows](const TruthState& now) { return rows.at(time::Nanoseconds(now.header.sim_time_ns)); });
}

}  // namespace inslab::verify
