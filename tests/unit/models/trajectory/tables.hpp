#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "inslab/scenario/trajectory.hpp"

/// Motion tables that several tests drive along.
namespace inslab::trajectory::tables {

using scenario::Axis;
using scenario::Motion;
using scenario::MotionType;
using scenario::Segment;
using scenario::Trajectory;

inline Motion motion(MotionType type) {
  Motion m;
  m.type = type;
  return m;
}
inline Motion delta_speed(double change_m_per_s) {
  Motion m = motion(MotionType::DeltaSpeed);
  m.speed_change_m_per_s = change_m_per_s;
  return m;
}
inline Motion target_speed(double final_m_per_s) {
  Motion m = motion(MotionType::TargetSpeed);
  m.final_speed_m_per_s = final_m_per_s;
  return m;
}
inline Motion turn(double angle_deg, Axis axis = Axis::Z) {
  Motion m = motion(MotionType::Turn);
  m.angle_deg = angle_deg;
  m.axis = axis;
  return m;
}
inline Motion constant_rate(double rate_deg_per_s, Axis axis = Axis::Z) {
  Motion m = motion(MotionType::ConstantRate);
  m.axis = axis;
  m.rate_deg_per_s = rate_deg_per_s;
  return m;
}
inline Motion sinusoid(MotionType type, double amplitude, double period_s, Axis axis) {
  Motion m = motion(type);
  (scenario::is_angular(type) ? m.amplitude_deg_per_s : m.amplitude_m_per_s2) = amplitude;
  m.period_s = period_s;
  m.axis = axis;
  return m;
}
inline Motion ramp_rate(double from_deg_per_s, double to_deg_per_s, Axis axis = Axis::Z) {
  Motion m = motion(MotionType::RampRate);
  m.axis = axis;
  m.from_deg_per_s = from_deg_per_s;
  m.to_deg_per_s = to_deg_per_s;
  return m;
}
inline Segment segment(double duration_s, std::vector<Motion> motions = {}) {
  Segment s;
  s.duration_s = duration_s;
  s.motions = std::move(motions);
  return s;
}
inline Trajectory at_wuhan(double yaw_deg = 30.0) {
  Trajectory t;
  t.initial.latitude_deg = 30.53;
  t.initial.longitude_deg = 114.35;
  t.initial.height_m = 20.0;
  t.initial.yaw_deg = yaw_deg;
  return t;
}

/// Ends the table at 20 minutes, with uniform motion.
inline Trajectory to_twenty_minutes(Trajectory t) {
  double total_s = 0.0;
  for (const Segment& s : t.segments) total_s += s.duration_s;
  t.segments.push_back(segment(std::round((1200.0 - total_s) * 1e9) * 1e-9));
  return t;
}

/// 20 minutes of level driving: one straight, then an L, an S and a circle; corners fall between the samples.
inline Trajectory basic() {
  Trajectory t = at_wuhan();
  t.segments = {segment(60.0), segment(10.0037, {delta_speed(15.0)})};
  for (int i = 0; i < 10; ++i) {
    t.segments.push_back(segment(40.0));
    t.segments.push_back(segment(9.0013, {turn(i % 3 == 0 ? -90.0 : 90.0)}));
    t.segments.push_back(segment(6.5, {ramp_rate(0.0, 8.0)}));
    t.segments.push_back(segment(30.0, {constant_rate(8.0)}));
    t.segments.push_back(segment(6.5, {ramp_rate(8.0, 0.0)}));
    t.segments.push_back(segment(12.00007, {sinusoid(MotionType::SineRate, i % 2 == 0 ? 5.0 : -5.0, 6.0, Axis::Z)}));
  }
  t.segments.push_back(segment(8.0, {target_speed(0.0)}));
  return to_twenty_minutes(t);
}

/// 20 minutes of stop and go with slopes.
inline Trajectory vehicle() {
  Trajectory t = at_wuhan(135.0);
  t.segments = {segment(300.0)};
  for (int i = 0; i < 15; ++i) {
    t.segments.push_back(segment(7.0031, {target_speed(8.0 + i)}));
    t.segments.push_back(segment(4.0, {turn(2.0, Axis::Y)}));
    t.segments.push_back(segment(6.1009, {turn(i % 2 == 0 ? 85.0 : -70.0)}));
    t.segments.push_back(segment(4.0, {turn(-2.0, Axis::Y)}));
    t.segments.push_back(segment(20.0, {sinusoid(MotionType::SineAccel, 0.4, 5.0, Axis::X)}));
    t.segments.push_back(segment(5.5, {turn(35.0), target_speed(4.0 + 0.5 * i)}));
    t.segments.push_back(segment(6.0, {target_speed(0.0)}));
  }
  return to_twenty_minutes(t);
}

/// 20 minutes of flight: climb, bumps about two axes at once, coordinated turns. Under a bank of 25 deg a level turn of
/// 2 deg/s is 2 sin(25 deg) about y and 2 cos(25 deg) about z.
inline Trajectory aircraft() {
  Trajectory t = at_wuhan(80.0);
  t.segments = {segment(20.0),  segment(30.0, {delta_speed(80.0)}),   segment(10.0, {turn(8.0, Axis::Y)}),
                segment(120.0), segment(10.0, {turn(-8.0, Axis::Y)}), segment(60.0, {delta_speed(120.0)})};
  for (int i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double y = 0.8452, z = 1.8126 * side;
    t.segments.push_back(segment(30.0));
    t.segments.push_back(segment(20.0, {sinusoid(MotionType::SineRate, 3.0, 2.0, Axis::X),
                                        sinusoid(MotionType::CosineRate, 1.0, 2.0, Axis::Y)}));
    t.segments.push_back(segment(5.0017, {turn(25.0 * side, Axis::X)}));
    t.segments.push_back(segment(3.0, {ramp_rate(0.0, y, Axis::Y), ramp_rate(0.0, z)}));
    t.segments.push_back(segment(40.0, {constant_rate(y, Axis::Y), constant_rate(z)}));
    t.segments.push_back(segment(3.0, {ramp_rate(y, 0.0, Axis::Y), ramp_rate(z, 0.0)}));
    t.segments.push_back(segment(5.0017, {turn(-25.0 * side, Axis::X), turn(i % 4 < 2 ? 3.0 * side : -3.0 * side)}));
  }
  return to_twenty_minutes(t);
}

/// 20 minutes at sea: roll, pitch and yaw sway about a course that the velocity keeps, and heave.
inline Trajectory ship() {
  Trajectory t = at_wuhan(0.0);
  t.initial.speed_m_per_s = 6.0;
  Segment sway = segment(
      280.0,
      {sinusoid(MotionType::CosineRate, 6.0, 8.0, Axis::X), sinusoid(MotionType::CosineRate, 2.5, 7.0, Axis::Y),
       sinusoid(MotionType::CosineRate, 0.8, 10.0, Axis::Z), sinusoid(MotionType::SineAccel, 0.3, 5.6, Axis::Z)});
  sway.keep_velocity_on_nose = false;
  for (int i = 0; i < 4; ++i) {
    t.segments.push_back(sway);
    t.segments.push_back(segment(20.0, {turn(45.0)}));
  }
  return t;
}

inline Motion ballistic(double drag_per_m = 0.0) {
  Motion m = motion(MotionType::Ballistic);
  m.drag_per_m = drag_per_m;
  return m;
}

/// A rocket's boost, its flight of minutes through the top of its arc, and a parachute's drag on the way down.
inline Trajectory rocket() {
  Trajectory t = at_wuhan(60.0);
  t.initial.speed_m_per_s = 300.0;
  t.initial.pitch_deg = 70.0;
  t.segments = {segment(5.0, {delta_speed(100.0)}), segment(40.0, {ballistic()}), segment(20.0, {ballistic(2e-4)})};
  return t;
}

}  // namespace inslab::trajectory::tables
