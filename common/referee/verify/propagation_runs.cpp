#include "inslab/referee/verify/propagation_runs.hpp"

#include <cmath>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/error_model.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/referee/verify/run_start.hpp"

namespace inslab::verify {
namespace {

constexpr double kLatitudeDeg = 30.0, kLongitudeDeg = 114.0;
constexpr double kPredictionStep_s = 1.0;

scenario::Trajectory at_rest(int duration_s) {
  scenario::Trajectory trajectory;
  trajectory.initial.latitude_deg = kLatitudeDeg;
  trajectory.initial.longitude_deg = kLongitudeDeg;
  scenario::Segment rest;
  rest.duration_s = duration_s;
  trajectory.segments.push_back(rest);
  return trajectory;
}

double metres_per_rad_north() { return nav::wgs84::meridian_radius_m(kLatitudeDeg * units::kDeg); }
double metres_per_rad_east() {
  return nav::wgs84::transverse_radius_m(kLatitudeDeg * units::kDeg) * std::cos(kLatitudeDeg * units::kDeg);
}

nav::NavState with_error(nav::NavState state, const ErrorState& x) {
  state.position.latitude_rad += x[0] / metres_per_rad_north();
  state.position.longitude_rad += x[1] / metres_per_rad_east();
  state.position.height_m -= x[2];
  state.v_n += x.segment<3>(3);
  state.q_nb = nav::quaternion_from_rotation_vector(-x.tail<3>()) * state.q_nb;
  return state;
}

imu::ImuModel::Setup setup_of(const RestingRun& run) {
  return {
      run.seed, 0, time::Rate(kRestingRateHz), nav::Gravity(), run.errors, VibrationProfile{}, InstallationProfile{}};
}

ErrorState error_of(const nav::NavState& found, const nav::NavState& truth) {
  ErrorState x;
  x << (found.position.latitude_rad - truth.position.latitude_rad) * metres_per_rad_north(),
      (found.position.longitude_rad - truth.position.longitude_rad) * metres_per_rad_east(),
      truth.position.height_m - found.position.height_m, found.v_n - truth.v_n,
      -nav::rotation_vector_from_quaternion(found.q_nb * truth.q_nb.conjugate());
  return x;
}

}  // namespace

nav::Geodetic resting_place() { return {kLatitudeDeg * units::kDeg, kLongitudeDeg * units::kDeg, 0.0}; }

std::vector<ErrorState> navigate_at_rest(const RestingRun& run, int every_s, const Subjects& subjects) {
  const time::Rate rate(kRestingRateHz);
  const nav::Gravity gravity;
  const auto truth = subjects.truth(at_rest(run.duration_s), rate);
  const Imu imu = subjects.imu(setup_of(run));
  imu(truth->current());
  const auto strapdown =
      subjects.mechanization(with_error(nav_state(truth->current()), run.start), gravity, {}, std::nullopt);
  std::vector<ErrorState> errors{run.start};
  const int steps_between = static_cast<int>(std::lround(every_s * kRestingRateHz));
  for (int k = 1; k <= run.duration_s / every_s * steps_between; ++k) {
    const TruthState now = truth->advance();
    const ImuSample sample = imu(now)->sample;
    strapdown->advance({sample.dtheta_b, sample.dv_b, rate.period_s()});
    if (run.vertical == predict::Vertical::Held) strapdown->hold_vertical(now.height_m, now.v_n.z());
    if (k % steps_between == 0) errors.push_back(error_of(strapdown->state(), nav_state(now)));
  }
  return errors;
}

std::vector<ErrorState> propagate_linearly(const ErrorState& start, const nav::Vector3& gyro_error_n,
                                           const nav::Vector3& accel_error_n, predict::Vertical vertical,
                                           int duration_s, int every_s) {
  const nav::Gravity gravity;
  const nav::Geodetic place = resting_place();
  nav::Matrix9 F = nav::error_dynamics(place, nav::Vector3::Zero(), -gravity.g_n(place), gravity);
  ErrorState drive;
  drive << nav::Vector3::Zero(), accel_error_n, -gyro_error_n;
  if (vertical == predict::Vertical::Held) {
    for (const int state : {2, 5}) {
      F.row(state).setZero();
      F.col(state).setZero();
      drive[state] = 0.0;
    }
  }
  std::vector<ErrorState> errors{start};
  ErrorState x = start;
  const auto slope = [&](const ErrorState& at) { return ErrorState(F * at + drive); };
  for (int second = 1; second <= duration_s; ++second) {
    const ErrorState k1 = slope(x), k2 = slope(x + 0.5 * k1), k3 = slope(x + 0.5 * k2), k4 = slope(x + k3);
    x += (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    if (second % every_s == 0) errors.push_back(x);
  }
  return errors;
}

predict::PredictedError predict_at_rest(const RestingRun& run) {
  const time::Rate rate(kRestingRateHz);
  trajectory::MotionTableModel truth(at_rest(run.duration_s), rate, kStart);
  predict::PredictedError start;
  start.position_n_m = run.start.head<3>().cwiseAbs();
  start.velocity_n_m_per_s = run.start.segment<3>(3).cwiseAbs();
  start.attitude_n_rad = run.start.tail<3>().cwiseAbs();
  predict::ErrorGrowth growth(run.errors, start, nav::Gravity(), run.vertical, kPredictionStep_s);
  imu::ImuModel imu(setup_of(run));
  imu.measure(truth.current());
  for (int k = 0; k < static_cast<int>(std::lround(run.duration_s * kRestingRateHz)); ++k) {
    growth.advance(imu.measure(truth.advance())->truth, 0.0, 0.0);
  }
  return growth.current();
}

}  // namespace inslab::verify
