#include "inslab/referee/verify/increments_block.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::verify {

namespace {

constexpr std::array<double, 3> kRates_hz{200.0, 400.0, 1000.0};
constexpr double kPeriod_s = 0.5;  ///< of the motions
constexpr double kOrderTolerance = 0.1;

scenario::Motion sinusoid(scenario::MotionType type, scenario::Axis axis, double amplitude) {
  scenario::Motion motion;
  motion.type = type;
  motion.axis = axis;
  motion.period_s = kPeriod_s;
  (scenario::is_angular(type) ? motion.amplitude_deg_per_s : motion.amplitude_m_per_s2) = amplitude;
  return motion;
}

/// One segment of motions that swing for ever, the velocity left alone by the turns.
scenario::Trajectory swinging(std::vector<scenario::Motion> motions) {
  scenario::Trajectory trajectory;
  trajectory.initial.latitude_deg = 30.53;
  trajectory.initial.longitude_deg = 114.35;
  trajectory.initial.height_m = 20.0;
  trajectory.initial.yaw_deg = 30.0;
  scenario::Segment segment;
  segment.duration_s = 1e4;
  segment.motions = std::move(motions);
  segment.keep_velocity_on_nose = false;
  trajectory.segments.push_back(segment);
  return trajectory;
}

scenario::Trajectory coning() {
  return swinging({sinusoid(scenario::MotionType::CosineRate, scenario::Axis::X, 25.0),
                   sinusoid(scenario::MotionType::SineRate, scenario::Axis::Y, 25.0)});
}

scenario::Trajectory sculling() {
  return swinging({sinusoid(scenario::MotionType::CosineRate, scenario::Axis::X, 25.0),
                   sinusoid(scenario::MotionType::SineAccel, scenario::Axis::Z, 5.0)});
}

enum class Algorithm { AsPrinted, FullRotationTerm, RateTimesInterval };

nav::ImuIncrements increments_of(const TruthState& truth, Algorithm algorithm) {
  const double dt_s = time::to_seconds(truth.interval_ns);
  if (algorithm == Algorithm::RateTimesInterval) return {dt_s * truth.omega_iv_v, dt_s * truth.f_v, dt_s};
  return {truth.dtheta_v, truth.dv_v, dt_s};
}

struct Errors {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double attitude_rad = 0.0;
};

/// RMS over the instants at which the motion has completed whole periods: elsewhere the trapezoid of (2-47) errs by
/// dt^2/12 of the acceleration's swing, which comes and goes and says nothing about drift.
Errors mechanize(const scenario::Trajectory& motion, Algorithm algorithm, double rate_hz, double duration_s,
                 const Subjects& subjects) {
  const auto model = subjects.truth(motion, time::Rate(rate_hz));
  const int per_period = static_cast<int>(std::lround(kPeriod_s * rate_hz));
  TruthState truth = model->current();
  for (int k = 0; k < per_period; ++k) truth = model->advance();
  const auto strapdown =
      subjects.mechanization(nav_state(truth), nav::Gravity(motion.gravity.model),
                             {algorithm == Algorithm::FullRotationTerm}, increments_of(truth, algorithm));
  Errors sum;
  const int periods = static_cast<int>(duration_s / kPeriod_s);
  for (int period = 0; period < periods; ++period) {
    for (int k = 0; k < per_period; ++k) {
      truth = model->advance();
      strapdown->advance(increments_of(truth, algorithm));
    }
    const nav::NavState found = strapdown->state(), expected = nav_state(truth);
    sum.position_m += nav::ned_from(expected.position, found.position).squaredNorm();
    sum.velocity_m_per_s += (found.v_n - expected.v_n).squaredNorm();
    sum.attitude_rad += std::pow(nav::angle_between(found.q_nb, expected.q_nb), 2.0);
  }
  return {std::sqrt(sum.position_m / periods), std::sqrt(sum.velocity_m_per_s / periods),
          std::sqrt(sum.attitude_rad / periods)};
}

/// Between two rates, from the errors at them.
double order(double coarse, double fine, double coarse_hz, double fine_hz) {
  return std::log(coarse / fine) / std::log(fine_hz / coarse_hz);
}

Row row(const std::string& quantity, const std::array<double, 3>& errors, int expected) {
  const double low = order(errors[0], errors[1], kRates_hz[0], kRates_hz[1]);
  const double high = order(errors[1], errors[2], kRates_hz[1], kRates_hz[2]);
  const auto near = [&](double found) { return std::abs(found - expected) <= kOrderTolerance; };
  return {
      {quantity, fmt::format("{:.2e}", errors[0]), fmt::format("{:.2e}", errors[1]), fmt::format("{:.2e}", errors[2]),
       fmt::format("{:.2f}", low), fmt::format("{:.2f}", high), std::to_string(expected)},
      near(low) && near(high)};
}

struct Case {
  std::string name;
  Algorithm algorithm;
  int order;  ///< of velocity and position
};

const std::array<Case, 3>& cases() {
  static const std::array<Case, 3> list{{{"increments, as printed", Algorithm::AsPrinted, 2},
                                         {"increments, full rotation term", Algorithm::FullRotationTerm, 4},
                                         {"rate * dt, as the thesis forms them", Algorithm::RateTimesInterval, 1}}};
  return list;
}

std::array<Errors, 3> at_all_rates(const scenario::Trajectory& motion, Algorithm algorithm, double duration_s,
                                   const Subjects& subjects) {
  std::array<Errors, 3> errors;
  for (std::size_t i = 0; i < kRates_hz.size(); ++i) {
    errors[i] = mechanize(motion, algorithm, kRates_hz[i], duration_s, subjects);
  }
  return errors;
}

}  // namespace

std::vector<Table> increments(double duration_s, const Subjects& subjects) {
  const std::vector<std::string> columns{"",        "200 Hz", "400 Hz", "1000 Hz", "order 200-400", "order 400-1000",
                                         "expected"};
  Table attitude{"Coning: attitude after " + fmt::format("{:g}", duration_s) + " s, RMS, deg", columns, {}, {}};
  Table motion{"Sculling: velocity (m/s) and position (m) after " + fmt::format("{:g}", duration_s) + " s, RMS",
               columns,
               {},
               {}};
  for (const Case& one : cases()) {
    const auto in_coning = at_all_rates(coning(), one.algorithm, duration_s, subjects);
    const auto in_sculling = at_all_rates(sculling(), one.algorithm, duration_s, subjects);
    const auto pick = [](const std::array<Errors, 3>& errors, double Errors::*member, double unit) {
      return std::array<double, 3>{unit * (errors[0].*member), unit * (errors[1].*member), unit * (errors[2].*member)};
    };
    attitude.rows.push_back(row(one.name, pick(in_coning, &Errors::attitude_rad, units::kDegPerRad),
                                one.algorithm == Algorithm::RateTimesInterval ? 1 : 4));
    motion.rows.push_back(row("velocity, " + one.name, pick(in_sculling, &Errors::velocity_m_per_s, 1.0), one.order));
    motion.rows.push_back(row("position, " + one.name, pick(in_sculling, &Errors::position_m, 1.0), one.order));
  }
  attitude.notes = {
      fmt::format("25 deg/s about x (cosine) and y (sine), period {} s; against the truth of the motion.", kPeriod_s)};
  motion.notes = {
      fmt::format("25 deg/s about x (cosine), 5 m/s^2 along z (sine), period {} s; after whole periods, "
                  "where the trapezoid of (2-47) leaves no swing of dt^2/12 of the acceleration.",
                  kPeriod_s)};
  return {attitude, motion};
}

}  // namespace inslab::verify
