#include "inslab/referee/verify/loop.hpp"

#include <algorithm>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/nav_state.hpp"
#include "inslab/models/trajectory/file_states.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/referee/verify/run_start.hpp"
#include "inslab/referee/verify/written_rows.hpp"

namespace inslab::verify {

namespace {

void write(WrittenRows& rows, const TruthState& truth) {
  TrajectoryRow row;
  row.position = geodetic_of(truth);
  row.v_n = truth.v_n;
  row.rpy = nav::rpy_from_quaternion(truth.q_nv);
  rows.add({truth.header.gps_week, truth.header.gps_time_of_week_ns}, row);
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

std::vector<DeviationFigures> close_loop(trajectory::TruthModel& truth, const ImuOf& imu_of,
                                         const nav::Gravity& gravity,
                                         const std::vector<LoopedMechanization>& mechanizations, const time::Rate& rate,
                                         std::uint64_t steps, const ExpectedState& expected) {
  const Imu imu = imu_of({0, 0, rate, gravity, ImuErrorProfile{}, VibrationProfile{}, InstallationProfile{}});
  imu(truth.current());
  std::vector<std::unique_ptr<Mechanization>> begun;
  for (const LoopedMechanization& one : mechanizations) {
    begun.push_back(one.mechanization(nav_state(truth.current()), gravity, one.options, std::nullopt));
  }
  std::vector<Deviation> deviations(begun.size(), Deviation(steps));
  for (std::uint64_t k = 0; k < steps; ++k) {
    const TruthState now = truth.advance();
    const ImuSample sample = imu(now)->sample;
    const nav::NavState here = expected(now);
    for (std::size_t i = 0; i < begun.size(); ++i) {
      begun[i]->advance({sample.dtheta_b, sample.dv_b, rate.period_s()});
      deviations[i].add(begun[i]->state(), here);
    }
  }
  std::vector<DeviationFigures> figures;
  for (const Deviation& deviation : deviations) figures.push_back(deviation.figures());
  return figures;
}

FileLoop close_file_loop(const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity,
                         const time::Rate& rate, const Subjects& subjects) {
  const auto truth = subjects.inverse(file, gravity, rate);
  trajectory::FileStates rows(file);
  const auto steps = static_cast<std::uint64_t>(truth->end() / rate.period());
  const std::vector<DeviationFigures> found =
      close_loop(*truth, subjects.imu, gravity, {{subjects.mechanization, {}}, {reference_mechanization, {}}}, rate,
                 steps, [&rows](const TruthState& now) { return rows.at(time::Nanoseconds(now.header.sim_time_ns)); });
  return {found.front(), found.back()};
}

}  // namespace inslab::verify
