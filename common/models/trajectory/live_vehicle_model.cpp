#include "inslab/models/trajectory/live_vehicle_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/checked_trajectory.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::trajectory {

namespace {

constexpr time::Nanoseconds kLongestLead = std::chrono::seconds(1);
constexpr double kNormTolerance = 1e-3;  // a quaternion of floats passes

// Gauss-Legendre with three nodes on steps of at most 5 ms errs by (omega dt)^6/2e6 of the step: below 1e-12 of it at
// 25 rad/s, and of an offset that decays by a tenth.
constexpr double kLongestStep_s = 5e-3;
constexpr double kLongestDecay = 0.1;
struct Node {
  double place;
  double weight;
};
constexpr std::array<Node, 3> kNodes{
    {{0.1127016653792583, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.8872983346207417, 5.0 / 18.0}}};

time::Nanoseconds milliseconds(double value) { return time::from_seconds(value * 1e-3); }

/// The vehicle at its time 0, moving on a straight line.
VehicleKnot initial_knot(const scenario::InitialState& initial, time::Nanoseconds time) {
  VehicleKnot knot;
  knot.time = time;
  knot.position = {initial.latitude_deg * units::kDeg, nav::wrapped_to_pi(initial.longitude_deg * units::kDeg),
                   initial.height_m};
  knot.q_nv = nav::quaternion_from_rpy(
      {initial.roll_deg * units::kDeg, initial.pitch_deg * units::kDeg, initial.yaw_deg * units::kDeg});
  knot.v_n = knot.q_nv * Vector3(initial.speed_m_per_s, 0.0, 0.0);
  return knot;
}

}  // namespace

/// Everything that a truth sample says of one instant.
struct LiveVehicleModel::Instant {
  nav::Geodetic position;
  Vector3 v_n;
  Quaternion q_nv;
  Vector3 omega_iv_v;
  Vector3 f_v;
};

LiveVehicleModel::LiveVehicleModel(const scenario::Trajectory& trajectory, const nav::Gravity& gravity,
                                   const time::Grid& grid, const time::GpsTime& start)
    : options_(checked(trajectory).vehicle),
      latency_(milliseconds(options_.latency_ms)),
      extrapolation_limit_(milliseconds(options_.extrapolation_limit_ms)),
      grid_(grid),
      start_(start),
      gravity_(gravity),
      newest_(initial_knot(trajectory.initial, latency_)),
      base_(newest_),
      piece_(LivePathPiece::beyond(base_, time::to_seconds(extrapolation_limit_))),
      piece_end_(latency_),
      offset_(options_.return_time_ms * 1e-3) {}

VehicleKnot LiveVehicleModel::knot_of(const VehicleState& state) const {
  VehicleKnot knot;
  knot.time = time::Nanoseconds(state.sim_time_ns) + latency_;
  knot.position = {state.latitude_rad, nav::wrapped_to_pi(state.longitude_rad), state.height_m};
  knot.v_n = state.v_n;
  knot.a_n = state.a_n;
  knot.q_nv = nav::canonical(state.q_nv);
  knot.omega_nv_v = state.omega_nv_v;
  return knot;
}

std::optional<std::string> LiveVehicleModel::reason_to_refuse(const VehicleState& state) const {
  if (const auto broken = limit_violation(state)) return broken->path + " " + broken->reason;
  if (std::abs(state.q_nv.norm() - 1.0) > kNormTolerance) {
    return "q_nv has the norm " + std::to_string(state.q_nv.norm()) + "; expected 1";
  }
  try {
    nav::check_domain(geodetic_of(state));
  } catch (const std::domain_error& error) {
    return error.what();
  }
  if (time::Nanoseconds(state.sim_time_ns) > now_ + kLongestLead) {
    return "sim_time_ns is more than a second ahead of the run";
  }
  const VehicleKnot knot = knot_of(state);
  if (knot.time <= newest_.time) return std::nullopt;
  const Vector3 predicted = 0.5 * time::to_seconds(knot.time - newest_.time) * (newest_.v_n + knot.v_n);
  const double jump_m = (nav::ned_from(newest_.position, knot.position) - predicted).norm();
  if (jump_m <= options_.jump_limit_m) return std::nullopt;
  return "the position is " + std::to_string(jump_m) + " m from where the last state leads; jump_limit_m is " +
         std::to_string(options_.jump_limit_m);
}

bool LiveVehicleModel::receive(const VehicleState& state) {
  ++link_.received;
  if (const auto reason = reason_to_refuse(state)) {
    ++link_.refused;
    link_.last_refusal = text::cut(text::shown(*reason), 160);
    return false;
  }
  const VehicleKnot knot = knot_of(state);
  if (knot.time <= newest_.time) {
    ++link_.not_newer;
    return false;
  }
  count(knot);
  newest_ = knot;
  upcoming_.push_back(knot);
  return true;
}

void LiveVehicleModel::count(const VehicleKnot& knot) {
  if (link_.used > 0) {
    const double periods = time::to_seconds(knot.time - newest_.time) * options_.nominal_rate_hz;
    link_.missing += static_cast<std::uint64_t>(std::max(0.0, std::round(periods) - 1.0));
  }
  if (knot.time <= now_) ++link_.late;
  ++link_.used;
}

/// The curve changes over to its next piece; what it is off by at this instant is left to die out.
void LiveVehicleModel::begin_next_piece() {
  const LivePathPiece left = piece_;
  LivePathPoint is = path_point(time::to_seconds(now_ - left.start()));
  if (upcoming_.empty()) {
    piece_ = LivePathPiece::beyond(base_, time::to_seconds(extrapolation_limit_));
    piece_end_ = time::Nanoseconds::max();
  } else {
    piece_ = LivePathPiece::between(base_, upcoming_.front());
    piece_end_ = upcoming_.front().time;
    base_ = upcoming_.front();
    upcoming_.pop_front();
  }
  is.r_e -= left.C_en() * nav::ned_from(left.origin(), piece_.origin());
  offset_.begin(now_, is, piece_.at(time::to_seconds(now_ - piece_.start())));
}

/// States that came after the truth had passed their time: the newest of them is where to go on from.
void LiveVehicleModel::drop_passed() {
  while (!upcoming_.empty() && upcoming_.front().time <= now_) {
    base_ = upcoming_.front();
    upcoming_.pop_front();
  }
}

void LiveVehicleModel::require_fresh(time::Nanoseconds instant) const {
  if (!is_extrapolating() || instant - base_.time <= extrapolation_limit_) return;
  throw std::runtime_error("at " + std::to_string(time::to_seconds(instant)) +
                           " s: no state of the vehicle since that of " +
                           std::to_string(time::to_seconds(base_.time - latency_)) + " s; extrapolation_limit_ms is " +
                           std::to_string(options_.extrapolation_limit_ms));
}

TruthState LiveVehicleModel::advance() {
  try {
    return advanced();
  } catch (const std::domain_error& error) {
    throw std::domain_error("at " + std::to_string(time::to_seconds(now_)) +
                            " s, following the vehicle's states: " + error.what());
  }
}

TruthState LiveVehicleModel::advanced() {
  ++sample_;
  const time::Nanoseconds end = grid_.after(now_);
  interval_ = end - now_;
  increments_ = {};
  if (is_extrapolating() && !upcoming_.empty()) {
    if (now_ > base_.time) ++link_.returns;
    drop_passed();
    begin_next_piece();
  }
  while (now_ < end) {
    if (now_ >= piece_end_) begin_next_piece();
    const time::Nanoseconds to = std::min(end, piece_end_);
    require_fresh(to);
    integrate_to(to);
  }
  if (is_extrapolating() && end > base_.time) {
    ++link_.truth_samples_extrapolated;
    link_.longest_extrapolation_s = std::max(link_.longest_extrapolation_s, time::to_seconds(end - base_.time));
  }
  return current();
}

void LiveVehicleModel::integrate_to(time::Nanoseconds end) {
  const double from_s = time::to_seconds(now_ - piece_.start());
  const double span_s = time::to_seconds(end - now_);
  const double longest_s = std::min(kLongestStep_s, kLongestDecay / offset_.decay_per_s());
  const int steps = static_cast<int>(std::ceil(span_s / longest_s * (1.0 - 1e-9)));
  const double step_s = span_s / steps;
  for (int i = 0; i < steps; ++i) {
    for (const Node& node : kNodes) {
      const Instant instant = at(from_s + (i + node.place) * step_s);
      increments_.dtheta_v += node.weight * step_s * instant.omega_iv_v;
      increments_.dv_v += node.weight * step_s * instant.f_v;
    }
  }
  now_ = end;
}

LivePathPoint LiveVehicleModel::path_point(double since_piece_s) const {
  return offset_.added_to(piece_.at(since_piece_s), since_piece_s + time::to_seconds(piece_.start() - offset_.start()));
}

LiveVehicleModel::Instant LiveVehicleModel::at(double since_piece_s) const {
  const LivePathPoint point = path_point(since_piece_s);
  Instant instant;
  instant.position = nav::displaced(piece_.origin(), piece_.C_en().transpose() * point.r_e);
  nav::check_domain(instant.position);
  const Matrix3 C_ne = nav::C_en(instant.position.latitude_rad, instant.position.longitude_rad).transpose();
  instant.v_n = C_ne * point.v_e;
  instant.q_nv = nav::canonical(point.q_nv);
  const Matrix3 C_vn = instant.q_nv.toRotationMatrix().transpose();
  const Vector3 omega_ie_n = nav::omega_ie_n(instant.position.latitude_rad);
  instant.omega_iv_v = point.omega_nv_v + C_vn * (omega_ie_n + nav::omega_en_n(instant.position, instant.v_n));
  // C_ne a_e is v_n' + omega_en x v_n, so of thesis (3-30) the Earth's own rate is left.
  instant.f_v = C_vn * (C_ne * point.a_e + 2.0 * omega_ie_n.cross(instant.v_n) - gravity_.g_n(instant.position));
  return instant;
}

TruthState LiveVehicleModel::current() const {
  const Instant instant = at(time::to_seconds(now_ - piece_.start()));
  TruthState truth;
  truth.header.sequence_number = sample_;
  truth.header.sim_time_ns = now_.count();
  const time::GpsTime gps = start_ + now_;
  truth.header.gps_week = gps.week;
  truth.header.gps_time_of_week_ns = gps.time_of_week_ns;
  truth.latitude_rad = instant.position.latitude_rad;
  truth.longitude_rad = instant.position.longitude_rad;
  truth.height_m = instant.position.height_m;
  truth.v_n = instant.v_n;
  truth.q_nv = instant.q_nv;
  truth.omega_iv_v = instant.omega_iv_v;
  truth.f_v = instant.f_v;
  truth.dtheta_v = increments_.dtheta_v;
  truth.dv_v = increments_.dv_v;
  truth.interval_ns = interval_.count();
  return truth;
}

}  // namespace inslab::trajectory
