#include "inslab/referee/verify/ecef_reference.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "inslab/foundation/time/rate.hpp"

namespace inslab::verify {

namespace {

namespace odeint = boost::numeric::odeint;
using scenario::Axis;
using scenario::Motion;
using scenario::MotionType;

constexpr double kTruthRate_hz = 200.0;
namespace earth = reference_earth;
constexpr Real kPi = earth::kPi;

/// What both solvers integrate: displacement in e (in kLength_m), q_nv, v_n (in kSpeed_m_per_s), and the integrals of
/// omega_iv_v (rad) and f_v (m/s): one tolerance of 1e-15 then is 1e-11 m, 1e-13 m/s, 2e-15 rad.
constexpr Real kLength_m = 1e4L, kSpeed_m_per_s = 1e2L;
using State = std::array<Real, 16>;

/// Thesis (3-10), its five pieces as printed, with (3-13).
Real turn_rate(Real x, Real t, Real A, Real theta) {
  const Real t1 = A * t, k = 4 * theta / (t * t * t * A * A * (1 - A));
  if (x <= t1 / 2) return k * x * x / 2;
  if (x <= t1) return k * t1 * x - k * t1 * t1 / 4 - k * x * x / 2;
  if (x <= t - t1) return k * t1 * t1 / 4;
  if (x <= t - t1 / 2) return -k * t1 * (x - t) - k * (x - t) * (x - t) / 2 - k * t1 * t1 / 4;
  return k * (x - t) * (x - t) / 2;
}

Real trapezoid(Real x, Real t, Real A, Real area) {
  const Real peak = area / (t - A * t);
  if (x < A * t) return peak * x / (A * t);
  return x > t - A * t ? peak * (t - x) / (A * t) : peak;
}

/// One segment, its times from the scenario's start.
struct Leg {
  const scenario::Segment& segment;
  Real start_s, duration_s;
  RealVector v_v_at_start;

  const Motion* ballistic() const {
    const bool alone = segment.motions.size() == 1 && segment.motions[0].type == MotionType::Ballistic;
    return alone ? &segment.motions[0] : nullptr;
  }

  void rates(Real t, RealVector& omega, RealVector& accel) const {
    const Real x = t - start_s, deg = kPi / 180;
    omega.setZero();
    accel.setZero();
    for (const Motion& m : segment.motions) {
      const auto axis = static_cast<int>(m.axis.value_or(scenario::is_angular(m.type) ? Axis::Z : Axis::X));
      const Real phase = 2 * kPi * x / m.period_s;
      switch (m.type) {
        case MotionType::Uniform:
        case MotionType::Ballistic:
          break;
        case MotionType::DeltaSpeed:
          accel[axis] += trapezoid(x, duration_s, m.ramp_fraction, m.speed_change_m_per_s);
          break;
        case MotionType::TargetSpeed:
          accel[axis] += trapezoid(x, duration_s, m.ramp_fraction, m.final_speed_m_per_s - v_v_at_start[axis]);
          break;
        case MotionType::ConstantAccel:
          accel[axis] += m.acceleration_m_per_s2;
          break;
        case MotionType::SineAccel:
          accel[axis] += m.amplitude_m_per_s2 * std::sin(phase);
          break;
        case MotionType::RampAccel:
          accel[axis] += m.from_m_per_s2 + (m.to_m_per_s2 - m.from_m_per_s2) * x / duration_s;
          break;
        case MotionType::Turn:
          omega[axis] += turn_rate(x, duration_s, m.ramp_fraction, m.angle_deg * deg);
          break;
        case MotionType::ConstantRate:
          omega[axis] += m.rate_deg_per_s * deg;
          break;
        case MotionType::SineRate:
          omega[axis] += m.amplitude_deg_per_s * deg * std::sin(phase);
          break;
        case MotionType::CosineRate:
          omega[axis] += m.amplitude_deg_per_s * deg * std::cos(phase);
          break;
        case MotionType::RampRate:
          omega[axis] += deg * (m.from_deg_per_s + (m.to_deg_per_s - m.from_deg_per_s) * x / duration_s);
          break;
      }
    }
  }

  /// Inside the segment: t1/2, t1, t - t1, t - t1/2 of every motion that has ramps.
  std::vector<Real> corners() const {
    std::vector<Real> times;
    for (const Motion& m : segment.motions) {
      const Real t1 = m.ramp_fraction * duration_s;
      for (const Real x : {t1 / 2, t1, duration_s - t1, duration_s - t1 / 2}) times.push_back(start_s + x);
    }
    return times;
  }
};

struct MotionInEcef {
  const Leg& leg;
  RealVector start_e;

  /// What the segment asks; of a ballistic one, what gravity and the Earth's rotation (`earth_n`) and drag leave.
  void motion(Real t, const RealQuaternion& q, const RealVector& v_n, const RealVector& earth_n, RealVector& omega_nv_v,
              RealVector& accel_n) const {
    const RealVector v_v = q.conjugate() * v_n;
    if (const Motion* ballistic = leg.ballistic()) {
      accel_n = earth_n - ballistic->drag_per_m * v_n.norm() * v_n;
      const Real x = t - leg.start_s, deg = kPi / 180;
      const Real slowed = ballistic->spin_decay_s > 0 ? std::exp(-x / ballistic->spin_decay_s) : Real(1);
      omega_nv_v = v_v.cross(q.conjugate() * accel_n) / v_n.squaredNorm() +
                   ballistic->spin_deg_per_s * deg * slowed * leg.v_v_at_start.normalized();
      return;
    }
    RealVector accel_v;
    leg.rates(t, omega_nv_v, accel_v);
    if (leg.segment.keep_velocity_on_nose) accel_v += omega_nv_v.cross(v_v);
    accel_n = q * accel_v;
  }

  void operator()(const State& y, State& dy, Real t) const {
    const RealVector r = start_e + kLength_m * RealVector(y[0], y[1], y[2]);
    const auto [lat, lon, h] = earth::geodetic(r);
    const Real s = std::sin(lat), c = std::cos(lat);
    const RealQuaternion q(y[3], y[4], y[5], y[6]);
    const RealVector v_n = kSpeed_m_per_s * RealVector(y[7], y[8], y[9]);
    const RealVector velocity_e = earth::C_en(lat, lon) * v_n;

    const Real g = earth::gravity_m_per_s2(s, h), N = earth::transverse_m(s), M = earth::meridian_m(s);
    const RealVector omega_ie_n(earth::kOmega_rad_per_s * c, 0, -earth::kOmega_rad_per_s * s);
    const RealVector omega_en_n(v_n.y() / (N + h), -v_n.x() / (M + h), -v_n.y() * s / (c * (N + h)));
    const RealVector omega_in_n = omega_ie_n + omega_en_n;
    const RealVector earth_n = RealVector(0, 0, g) - (omega_ie_n + omega_in_n).cross(v_n);
    RealVector omega_nv_v, accel_n;
    motion(t, q, v_n, earth_n, omega_nv_v, accel_n);
    const RealVector f_v = q.conjugate() * (accel_n - earth_n);
    const RealVector omega_iv_v = omega_nv_v + q.conjugate() * omega_in_n;

    const RealQuaternion dq = q * RealQuaternion(0, omega_nv_v.x() / 2, omega_nv_v.y() / 2, omega_nv_v.z() / 2);
    const RealVector dr = velocity_e / kLength_m, dv = accel_n / kSpeed_m_per_s;
    const Real out[16] = {dr.x(), dr.y(), dr.z(),         dq.w(),         dq.x(),         dq.y(),  dq.z(),  dv.x(),
                          dv.y(), dv.z(), omega_iv_v.x(), omega_iv_v.y(), omega_iv_v.z(), f_v.x(), f_v.y(), f_v.z()};
    std::copy(out, out + 16, dy.begin());
  }
};

/// The segments up to `duration_s`, with what follows the last. Throws std::invalid_argument for motions whose end this
/// reference does not look for.
std::vector<scenario::Segment> legs_of(const scenario::Trajectory& trajectory, double duration_s) {
  if (const auto broken = scenario::violation(trajectory))
    throw std::invalid_argument(broken->path + " " + broken->reason);
  const scenario::GravityOptions& gravity = trajectory.gravity;
  if (gravity.model != nav::GravityModel::Somigliana || gravity.disturbance_mgal != 0 ||
      gravity.deflection_north_arcsec != 0 || gravity.deflection_east_arcsec != 0 || gravity.variation) {
    throw std::invalid_argument("gravity is not that of the reference: somigliana without disturbance");
  }
  std::vector<scenario::Segment> segments = trajectory.segments;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    for (const Motion& m : segments[i].motions) {
      if (m.until_start_height) throw std::invalid_argument("only the last segment may end at its start's height");
    }
  }
  scenario::Segment rest;
  rest.duration_s = duration_s;
  segments.push_back(rest);
  return segments;
}

State state_at(const scenario::Trajectory& trajectory, const TruthState& start) {
  const RealVector v_n = start.q_nv.cast<Real>() * RealVector(trajectory.initial.speed_m_per_s, 0, 0);
  const RealQuaternion q = start.q_nv.cast<Real>();
  State y{};
  const Real from[] = {
      q.w(), q.x(), q.y(), q.z(), v_n.x() / kSpeed_m_per_s, v_n.y() / kSpeed_m_per_s, v_n.z() / kSpeed_m_per_s};
  std::copy(std::begin(from), std::end(from), y.begin() + 3);
  return y;
}

ReferenceState reference_of(const State& y, Real time_s) {
  ReferenceState reference;
  reference.time_s = time_s;
  reference.displacement_e_m = kLength_m * RealVector(y[0], y[1], y[2]);
  reference.q_nv = RealQuaternion(y[3], y[4], y[5], y[6]);
  reference.v_n = kSpeed_m_per_s * RealVector(y[7], y[8], y[9]);
  reference.dtheta_v = {y[10], y[11], y[12]};
  reference.dv_v = {y[13], y[14], y[15]};
  return reference;
}

template <class Stepper>
std::vector<ReferenceState> solve(const scenario::Trajectory& trajectory, const TruthState& start, Real duration_s,
                                  const Stepper& stepper) {
  const RealVector start_e = earth::ecef_m(start.latitude_rad, start.longitude_rad, start.height_m);
  State y = state_at(trajectory, start);
  std::vector<ReferenceState> seconds;
  Real now_s = 0;
  time::Nanoseconds leg_end{0};
  for (const scenario::Segment& segment : legs_of(trajectory, static_cast<double>(duration_s))) {
    const RealQuaternion q(y[3], y[4], y[5], y[6]);
    const time::Nanoseconds length = time::from_seconds(segment.duration_s);
    leg_end += length;
    const Leg leg{segment, now_s, static_cast<Real>(length.count()) / 1e9L,
                  q.conjugate() * RealVector(y[7], y[8], y[9]) * kSpeed_m_per_s};
    const MotionInEcef motion{leg, start_e};
    const Real end_s = static_cast<Real>(leg_end.count()) / 1e9L;
    std::vector<Real> stops = leg.corners();
    for (Real s = std::floor(now_s) + 1; s <= end_s; s += 1) stops.push_back(s);
    stops.push_back(end_s);
    std::sort(stops.begin(), stops.end());
    for (const Real stop : stops) {
      if (stop <= now_s || stop > end_s) continue;
      if (stop > duration_s) return seconds;
      odeint::integrate_adaptive(stepper, motion, y, now_s, stop, std::min((stop - now_s) / 4, Real(1e-3L)));
      now_s = stop;
      if (stop != std::floor(stop)) continue;
      seconds.push_back(reference_of(y, stop));
      std::fill(y.begin() + 10, y.end(), Real(0));
    }
  }
  return seconds;
}

/// Adds the squares of one second's differences; the truth is advanced to the second's end.
void add_second(trajectory::TruthModel& model, const ReferenceState& reference, const RealVector& start_e,
                Differences& sum) {
  RealVector dtheta = RealVector::Zero(), dv = RealVector::Zero();
  TruthState truth;
  for (int i = 0; i < static_cast<int>(kTruthRate_hz); ++i) {
    truth = model.advance();
    dtheta += truth.dtheta_v.cast<Real>();
    dv += truth.dv_v.cast<Real>();
  }
  const RealVector moved = earth::ecef_m(truth.latitude_rad, truth.longitude_rad, truth.height_m) - start_e;
  const RealQuaternion turned = truth.q_nv.cast<Real>().conjugate() * reference.q_nv;
  sum.position_m += (moved - reference.displacement_e_m).squaredNorm();
  sum.velocity_m_per_s += (truth.v_n.cast<Real>() - reference.v_n).squaredNorm();
  sum.attitude_deg += std::pow(2 * 180 / kPi * turned.vec().norm(), 2);
  sum.dtheta_rad += (dtheta - reference.dtheta_v).squaredNorm();
  sum.dv_m_per_s += (dv - reference.dv_v).squaredNorm();
  sum.dv_size_m_per_s += reference.dv_v.squaredNorm();
}

}  // namespace

std::vector<ReferenceState> solve_in_ecef(const scenario::Trajectory& trajectory, const TruthState& start,
                                          double duration_s, Solver solver) {
  constexpr Real kTolerance = 1e-15L;
  if (solver == Solver::BulirschStoer) {
    return solve(trajectory, start, duration_s, odeint::bulirsch_stoer<State, Real>(kTolerance, 0.0L));
  }
  using DormandPrince = odeint::runge_kutta_dopri5<State, Real, State, Real>;
  return solve(trajectory, start, duration_s, odeint::make_controlled(kTolerance, 0.0L, DormandPrince()));
}

Differences compare_with_ecef(const scenario::Trajectory& trajectory, double duration_s, const TruthOf& truth) {
  const auto model = truth(trajectory, time::Rate(kTruthRate_hz));
  const TruthState start = model->current();
  const double end_s = std::min(duration_s, time::to_seconds(model->end()));
  const auto reference = solve_in_ecef(trajectory, start, end_s, Solver::BulirschStoer);
  const auto second = solve_in_ecef(trajectory, start, end_s, Solver::DormandPrince);
  const RealVector start_e = earth::ecef_m(start.latitude_rad, start.longitude_rad, start.height_m);
  Differences rms;
  rms.seconds = reference.size();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    rms.solvers_m = std::max(rms.solvers_m, (second.at(i).displacement_e_m - reference[i].displacement_e_m).norm());
    add_second(*model, reference[i], start_e, rms);
  }
  for (Real* value : {&rms.position_m, &rms.velocity_m_per_s, &rms.attitude_deg, &rms.dtheta_rad, &rms.dv_m_per_s,
                      &rms.dv_size_m_per_s}) {
    *value = std::sqrt(*value / static_cast<Real>(rms.seconds));
  }
  return rms;
}

}  // namespace inslab::verify
