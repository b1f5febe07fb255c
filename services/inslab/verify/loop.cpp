#include "services/inslab/verify/loop.hpp"

#include <algorithm>
#include <cmath>

#include "services/imu_error_injector/model.hpp"
#include "services/trajectory_server/inverse_mechanization_model.hpp"
#include "services/trajectory_server/motion_table_model.hpp"

namespace inslab::verify {

namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
const time::GpsTime kStart{2300, 0};

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }
double rounded_angle_rad(double rad, double per_deg) { return rounded(rad * kDegPerRad, per_deg) / kDegPerRad; }

io::TrajectoryRow row_as_written(const TruthState& truth) {
  const nav::RollPitchYaw rpy = nav::rpy_from_quaternion(truth.q_nv);
  io::TrajectoryRow row;
  row.time = time::Nanoseconds(truth.header.sim_time_ns);
  row.position = {rounded_angle_rad(truth.latitude_rad, 1e12), rounded_angle_rad(truth.longitude_rad, 1e12),
                  rounded(truth.height_m, 1e6)};
  row.v_n = truth.v_n.unaryExpr([](double v) { return rounded(v, 1e6); });
  row.rpy = {rounded_angle_rad(rpy.roll_rad, 1e9), rounded_angle_rad(rpy.pitch_rad, 1e9),
             rounded_angle_rad(rpy.yaw_rad, 1e9)};
  return row;
}

nav::NavState state_of(const TruthState& truth) {
  return {{truth.latitude_rad, truth.longitude_rad, truth.height_m}, truth.v_n, truth.q_nv};
}

imu::ImuModel perfect_imu(const nav::Gravity& gravity, const time::Rate& rate) {
  return imu::ImuModel({0, 0, rate, rate, gravity, ImuErrorProfile{}, VibrationProfile{}, InstallationProfile{}});
}

}  // namespace

std::shared_ptr<const io::TrajectoryFile> rows_as_written(const scenario::Trajectory& trajectory,
                                                          const std::string& name, const time::Rate& rate,
                                                          time::Nanoseconds duration) {
  auto file = std::make_shared<io::TrajectoryFile>();
  file->name = name;
  file->start = kStart;
  trajectory::MotionTableModel model(trajectory, rate, kStart);
  file->rows.push_back(row_as_written(model.current()));
  while (file->rows.back().time + rate.period() <= std::min(duration, model.end()))
    file->rows.push_back(row_as_written(model.advance()));
  return file;
}

DeviationFigures close_loop(trajectory::TruthModel& truth, const nav::Gravity& gravity,
                            const nav::Strapdown::Options& options, const time::Rate& rate, std::uint64_t steps,
                            const std::function<nav::NavState(const TruthState&)>& expected) {
  imu::ImuModel imu = perfect_imu(gravity, rate);
  imu.measure(truth.current());
  nav::Strapdown strapdown(state_of(truth.current()), gravity, options);
  Deviation deviation(steps);
  for (std::uint64_t k = 0; k < steps; ++k) {
    const TruthState now = truth.advance();
    const ImuSample sample = imu.measure(now)->sample;
    strapdown.advance({sample.dtheta_b, sample.dv_b, rate.period_s()});
    deviation.add(strapdown.state(), expected(now));
  }
  return deviation.figures();
}

DeviationFigures close_file_loop(const std::shared_ptr<const io::TrajectoryFile>& file, const nav::Gravity& gravity,
                                 const time::Rate& rate) {
  trajectory::InverseMechanizationModel truth(file, gravity, {}, rate, kStart);
  trajectory::FileStates rows(file);
  const auto steps = static_cast<std::uint64_t>(truth.end() / rate.period());
  return close_loop(truth, gravity, {}, rate, steps,
                    [&rows](const TruthState& now) { return rows.at(time::Nanoseconds(now.header.sim_time_ns)); });
}

}  // namespace inslab::verify
