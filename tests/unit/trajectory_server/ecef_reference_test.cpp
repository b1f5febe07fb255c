// The truth against an independent solution: the same motion written in ECEF as displacement from the start, in
// extended precision, solved by two general methods of Boost.Odeint that agree with each other. Nothing of the
// integrator is shared: motions, ellipsoid and gravity are written again from their sources.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <sstream>
#include <vector>

#include "services/trajectory_server/motion_table_model.hpp"
#include "tests/unit/trajectory_server/tables.hpp"

namespace inslab::trajectory {
namespace {

namespace odeint = boost::numeric::odeint;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealQuaternion = Eigen::Quaternion<Real>;
using tables::Axis;
using tables::Motion;
using tables::MotionType;

constexpr Real kPi = 3.14159265358979323846264338327950288L;
constexpr Real kA = 6378137.0L, kF = 1.0L / 298.257223563L, kE2 = kF * (2.0L - kF), kOmega = 7.292115e-5L;

/// Displacement in e (in kLength_m), q_nv, v_n (in kSpeed_m_per_s), and the integrals of omega_iv_v (rad) and f_v
/// (m/s): one tolerance of 1e-15 then is 1e-11 m, 1e-13 m/s, 2e-15 rad.
constexpr Real kLength_m = 1e4L, kSpeed_m_per_s = 1e2L;
using State = std::array<Real, 16>;

RealVector ecef(Real latitude, Real longitude, Real height) {
  const Real N = kA / std::sqrt(1 - kE2 * std::sin(latitude) * std::sin(latitude));
  return {(N + height) * std::cos(latitude) * std::cos(longitude),
          (N + height) * std::cos(latitude) * std::sin(longitude), (N * (1 - kE2) + height) * std::sin(latitude)};
}

/// Latitude by fixed-point iteration, which contracts by e2 a round: 9 rounds leave 1e-20.
std::array<Real, 3> geodetic(const RealVector& r) {
  const Real p = std::sqrt(r.x() * r.x() + r.y() * r.y());
  Real latitude = std::atan2(r.z(), p * (1 - kE2)), N = kA, height = 0;
  for (int i = 0; i < 9; ++i) {
    N = kA / std::sqrt(1 - kE2 * std::sin(latitude) * std::sin(latitude));
    height = p / std::cos(latitude) - N;
    latitude = std::atan2(r.z(), p * (1 - kE2 * N / (N + height)));
  }
  return {latitude, std::atan2(r.y(), r.x()), height};
}

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

struct Leg {
  const scenario::Segment& segment;
  Real start_s, duration_s;
  RealVector v_v_at_start;

  void rates(Real t, RealVector& omega, RealVector& accel) const {
    const Real x = t - start_s, deg = kPi / 180;
    omega.setZero();
    accel.setZero();
    for (const Motion& m : segment.motions) {
      const auto axis = static_cast<int>(m.axis.value_or(scenario::is_angular(m.type) ? Axis::Z : Axis::X));
      const Real phase = 2 * kPi * x / m.period_s;
      switch (m.type) {
        case MotionType::Uniform:
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

  void operator()(const State& y, State& dy, Real t) const {
    const RealVector r = start_e + kLength_m * RealVector(y[0], y[1], y[2]);
    const auto [lat, lon, h] = geodetic(r);
    const Real s = std::sin(lat), c = std::cos(lat), sl = std::sin(lon), cl = std::cos(lon);
    const RealVector north(-s * cl, -s * sl, c), east(-sl, cl, 0), down(-c * cl, -c * sl, -s);
    const RealQuaternion q(y[3], y[4], y[5], y[6]);
    const RealVector v_n = kSpeed_m_per_s * RealVector(y[7], y[8], y[9]);
    RealVector omega_nv_v, accel_v;
    leg.rates(t, omega_nv_v, accel_v);
    const RealVector v_v = q.conjugate() * v_n;
    if (leg.segment.keep_velocity_on_nose) accel_v += omega_nv_v.cross(v_v);
    const RealVector accel_n = q * accel_v;
    const RealVector velocity_e = v_n.x() * north + v_n.y() * east + v_n.z() * down;

    // TR8350.2 (4-1), (4-3).
    const Real W2 = 1 - kE2 * s * s, x = h / kA;
    const Real g = 9.7803253359L * (1 + 0.00193185265241L * s * s) / std::sqrt(W2) *
                   (1 - 2 * (1 + kF + 0.00344978650684L - 2 * kF * s * s) * x + 3 * x * x);
    const Real N = kA / std::sqrt(W2), M = kA * (1 - kE2) / (W2 * std::sqrt(W2));
    const RealVector omega_ie_n(kOmega * c, 0, -kOmega * s);
    const RealVector omega_en_n(v_n.y() / (N + h), -v_n.x() / (M + h), -v_n.y() * s / (c * (N + h)));
    const RealVector omega_in_n = omega_ie_n + omega_en_n;
    const RealVector f_n = accel_n + (omega_ie_n + omega_in_n).cross(v_n) - RealVector(0, 0, g);
    const RealVector omega_iv_v = omega_nv_v + q.conjugate() * omega_in_n, f_v = q.conjugate() * f_n;

    const RealQuaternion dq = q * RealQuaternion(0, omega_nv_v.x() / 2, omega_nv_v.y() / 2, omega_nv_v.z() / 2);
    const RealVector dr = velocity_e / kLength_m, dv = accel_n / kSpeed_m_per_s;
    const Real out[16] = {dr.x(), dr.y(), dr.z(),         dq.w(),         dq.x(),         dq.y(),  dq.z(),  dv.x(),
                          dv.y(), dv.z(), omega_iv_v.x(), omega_iv_v.y(), omega_iv_v.z(), f_v.x(), f_v.y(), f_v.z()};
    std::copy(out, out + 16, dy.begin());
  }
};

/// The state every second, and the increments of that second.
template <class Stepper>
std::vector<State> solve(const scenario::Trajectory& trajectory, const TruthState& start, Stepper stepper) {
  std::vector<State> seconds;
  const RealVector start_e = ecef(start.latitude_rad, start.longitude_rad, start.height_m);
  const RealVector v_n = start.q_nv.cast<Real>() * RealVector(trajectory.initial.speed_m_per_s, 0, 0);
  State y{0,
          0,
          0,
          start.q_nv.w(),
          start.q_nv.x(),
          start.q_nv.y(),
          start.q_nv.z(),
          v_n.x() / kSpeed_m_per_s,
          v_n.y() / kSpeed_m_per_s,
          v_n.z() / kSpeed_m_per_s};
  Real now_s = 0;
  for (const scenario::Segment& segment : trajectory.segments) {
    const RealQuaternion q(y[3], y[4], y[5], y[6]);
    const Leg leg{segment, now_s, segment.duration_s, q.conjugate() * RealVector(y[7], y[8], y[9]) * kSpeed_m_per_s};
    const MotionInEcef motion{leg, start_e};
    const Real end_s = now_s + leg.duration_s;
    std::vector<Real> stops = leg.corners();
    for (Real s = std::floor(now_s) + 1; s <= end_s; s += 1) stops.push_back(s);
    stops.push_back(end_s);
    std::sort(stops.begin(), stops.end());
    for (const Real stop : stops) {
      if (stop <= now_s || stop > end_s) continue;
      odeint::integrate_adaptive(stepper, motion, y, now_s, stop, (stop - now_s) / 4);
      now_s = stop;
      if (stop != std::floor(stop)) continue;
      seconds.push_back(y);
      std::fill(y.begin() + 10, y.end(), Real(0));
    }
  }
  return seconds;
}

struct Differences {
  Real position_m = 0, velocity_m_per_s = 0, attitude_deg = 0, dtheta_rad = 0, dv_m_per_s = 0;  // RMS
};

Differences difference(const scenario::Trajectory& trajectory, const std::vector<State>& reference) {
  MotionTableModel model(trajectory, time::Rate(200.0), {2300, 0});
  const TruthState start = model.current();
  const RealVector start_e = ecef(start.latitude_rad, start.longitude_rad, start.height_m);
  Differences sum;
  for (const State& y : reference) {
    RealVector dtheta = RealVector::Zero(), dv = RealVector::Zero();
    TruthState truth;
    for (int i = 0; i < 200; ++i) {
      truth = model.advance();
      dtheta += truth.dtheta_v.cast<Real>();
      dv += truth.dv_v.cast<Real>();
    }
    const RealVector moved = ecef(truth.latitude_rad, truth.longitude_rad, truth.height_m) - start_e;
    sum.position_m += (moved - kLength_m * RealVector(y[0], y[1], y[2])).squaredNorm();
    sum.velocity_m_per_s += (truth.v_n.cast<Real>() - kSpeed_m_per_s * RealVector(y[7], y[8], y[9])).squaredNorm();
    const RealQuaternion error = truth.q_nv.cast<Real>().conjugate() * RealQuaternion(y[3], y[4], y[5], y[6]);
    sum.attitude_deg += std::pow(2 * 180 / kPi * error.vec().norm(), 2);
    sum.dtheta_rad += (dtheta - RealVector(y[10], y[11], y[12])).squaredNorm();
    sum.dv_m_per_s += (dv - RealVector(y[13], y[14], y[15])).squaredNorm();
  }
  for (Real* value : {&sum.position_m, &sum.velocity_m_per_s, &sum.attitude_deg, &sum.dtheta_rad, &sum.dv_m_per_s}) {
    *value = std::sqrt(*value / static_cast<Real>(reference.size()));
  }
  return sum;
}

struct Case {
  const char* name;
  scenario::Trajectory (*table)();
};

class EcefReference : public testing::TestWithParam<Case> {};

TEST_P(EcefReference, AgreesToAMicrometreOverTwentyMinutes) {
  const scenario::Trajectory trajectory = GetParam().table();
  const TruthState start = MotionTableModel(trajectory, time::Rate(200.0), {2300, 0}).current();
  const auto reference = solve(trajectory, start, odeint::bulirsch_stoer<State, Real>(1e-15L, 0.0L));
  ASSERT_GE(reference.size(), 1199U);

  const auto second = solve(
      trajectory, start, odeint::make_controlled(1e-15L, 0.0L, odeint::runge_kutta_dopri5<State, Real, State, Real>()));
  ASSERT_EQ(second.size(), reference.size());
  Real apart_m = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    for (int j = 0; j < 3; ++j) apart_m = std::max(apart_m, kLength_m * std::abs(second[i][j] - reference[i][j]));
  }
  EXPECT_LT(apart_m, 1e-8L) << "the two reference solvers disagree";

  const Differences rms = difference(trajectory, reference);
  const auto record = [](const char* name, Real value) {
    std::ostringstream text;
    text << value;
    RecordProperty(name, text.str());
  };
  record("solvers_m", apart_m);
  record("position_m", rms.position_m);
  record("velocity_m_per_s", rms.velocity_m_per_s);
  record("attitude_deg", rms.attitude_deg);
  record("dtheta_rad", rms.dtheta_rad);
  record("dv_m_per_s", rms.dv_m_per_s);
  EXPECT_LE(rms.position_m, 1e-6L);
  EXPECT_LE(rms.velocity_m_per_s, 1e-8L);
  EXPECT_LE(rms.attitude_deg, 1e-9L);
  // The increments of a second: an attitude that is 1e-9 deg off turns 9.8 m/s by 1.7e-10 m/s, and Earth rate by
  // 1.3e-15 rad; each of 200 samples adds a rounding of 1e-19 rad.
  EXPECT_LE(rms.dv_m_per_s, 1.7e-10L);
  EXPECT_LE(rms.dtheta_rad, 1e-14L);
}

INSTANTIATE_TEST_SUITE_P(Tables, EcefReference,
                         testing::Values(Case{"basic", tables::basic}, Case{"vehicle", tables::vehicle},
                                         Case{"aircraft", tables::aircraft}, Case{"ship", tables::ship}),
                         [](const auto& table) { return table.param.name; });

}  // namespace
}  // namespace inslab::trajectory
