#include "inslab/models/trajectory/motion_table_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/ballistic_flight.hpp"
#include "inslab/models/trajectory/checked_trajectory.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::trajectory {

namespace {

VehicleMotion vehicle_at_start(const scenario::Trajectory& trajectory, const nav::Gravity& gravity) {
  const scenario::InitialState& initial = trajectory.initial;
  return VehicleMotion({initial.latitude_deg * units::kDeg, initial.longitude_deg * units::kDeg, initial.height_m},
                       Vector3(initial.speed_m_per_s, 0.0, 0.0),
                       nav::quaternion_from_rpy({initial.roll_deg * units::kDeg, initial.pitch_deg * units::kDeg,
                                                 initial.yaw_deg * units::kDeg}),
                       gravity);
}

}  // namespace

/// Does `action`; a std::domain_error that leaves it says when and where.
template <class Action>
void MotionTableModel::located(Action action) {
  try {
    action();
  } catch (const std::domain_error& error) {
    const bool inside = segment_ < trajectory_.segments.size();
    throw std::domain_error(
        "at " + std::to_string(time::to_seconds(now_)) + " s, " +
        (inside ? "segment " + std::to_string(segment_) + " '" + trajectory_.segments[segment_].name + "'"
                : "after the last segment") +
        ": " + error.what());
  }
}

MotionTableModel::MotionTableModel(const scenario::Trajectory& trajectory, const nav::Gravity& gravity,
                                   const time::Grid& grid, const time::GpsTime& start)
    : trajectory_(checked(trajectory)), grid_(grid), start_(start), vehicle_(vehicle_at_start(trajectory, gravity)) {
  located([this] { begin_segment(); });
}

MotionTableModel::MotionTableModel(const scenario::Trajectory& trajectory, const time::Grid& grid,
                                   const time::GpsTime& start)
    : MotionTableModel(trajectory, scenario::uniform_gravity(trajectory.gravity), grid, start) {}

TruthState MotionTableModel::advance() {
  rate_jump_ = false;
  ++sample_;
  const time::Nanoseconds end = grid_.after(now_);
  interval_ = end - now_;
  located([this, end] {
    advance_to(end);
    nav::check_domain(vehicle_.position());
  });
  increments_ = vehicle_.take_increments();
  return current();
}

void MotionTableModel::advance_to(time::Nanoseconds end) {
  while (now_ < end) {
    const time::Nanoseconds joint = segment_ < trajectory_.segments.size()
                                        ? segment_start_ + vehicle_.segment().joints()[joint_]
                                        : time::Nanoseconds::max();
    integrate_to(std::min(joint, end));
    if (now_ < joint) continue;
    if (++joint_ < vehicle_.segment().joints().size()) continue;
    ++segment_;
    segment_start_ = now_;
    const bool jumps = begin_segment();
    rate_jump_ = jumps && now_ == end;
  }
}

/// In equal steps within one smooth piece of the segment.
void MotionTableModel::integrate_to(time::Nanoseconds end) {
  const double t0_s = time::to_seconds(now_ - segment_start_);
  const double t1_s = time::to_seconds(end - segment_start_);
  const double span_s = time::to_seconds(end - now_);
  // A hair more than one step is one step: 5 ms is not a binary number.
  const int steps = static_cast<int>(std::ceil(span_s / vehicle_.longest_step_s() * (1.0 - 1e-9)));
  double from_s = t0_s;
  for (int i = 1; i <= steps; ++i) {
    const double to_s = i == steps ? t1_s : t0_s + span_s * i / steps;
    vehicle_.step(from_s, to_s, span_s / steps);
    from_s = to_s;
  }
  now_ = end;
}

bool MotionTableModel::begin_segment() {
  joint_ = 0;
  if (segment_ >= trajectory_.segments.size()) return vehicle_.begin(MotionSegment::endless());
  MotionSegment segment(trajectory_.segments[segment_], vehicle_.v_v());
  if (segment.ends_at_start_height()) {
    VehicleMotion trial = vehicle_;
    trial.begin(segment);
    segment.end_after(time_back_at_start_height(std::move(trial), segment.duration()));
    if (segment_ + 1 == trajectory_.segments.size()) end_ = segment_start_ + segment.duration();
  }
  return vehicle_.begin(std::move(segment));
}

TruthState MotionTableModel::current() const {
  TruthState truth;
  truth.header.sequence_number = sample_;
  truth.header.sim_time_ns = now_.count();
  const time::GpsTime gps = start_ + now_;
  truth.header.gps_week = gps.week;
  truth.header.gps_time_of_week_ns = gps.time_of_week_ns;
  const nav::Geodetic position = vehicle_.position();
  truth.latitude_rad = position.latitude_rad;
  truth.longitude_rad = position.longitude_rad;
  truth.height_m = position.height_m;
  truth.v_n = vehicle_.v_n();
  truth.q_nv = vehicle_.q_nv();
  truth.omega_iv_v = vehicle_.omega_iv_v();
  truth.f_v = vehicle_.f_v();
  truth.dtheta_v = increments_.dtheta_v;
  truth.dv_v = increments_.dv_v;
  truth.interval_ns = interval_.count();
  truth.segment_index = static_cast<std::uint32_t>(segment_);
  truth.rate_jump = rate_jump_;
  return truth;
}

}  // namespace inslab::trajectory
