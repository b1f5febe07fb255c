#include "inslab/models/trajectory/attitude_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kOffArc_rad = 2e-5;
constexpr double kPointsOfPeriod = 64.0;

}  // namespace

bool AttitudeLaw::waits(const scenario::PathPiece& piece) {
  return piece.law.first(0.0) == 0.0 && piece.law.first(time::to_seconds(piece.end - piece.start)) == 0.0 &&
         piece.law.first(0.5 * time::to_seconds(piece.end - piece.start)) == 0.0;
}

ClassAttitude::ClassAttitude(const scenario::VehicleAttitude& attitude, YawSchedule yaw, const nav::Gravity& gravity,
                             std::optional<RowNose> nose)
    : attitude_(attitude), yaw_(std::move(yaw)), gravity_(gravity), nose_(std::move(nose)) {
  const double shortest_s = std::min(attitude_.roll_period_s, attitude_.pitch_period_s);
  if (sways()) farthest_ = std::min(farthest_, time::from_seconds(shortest_s / kPointsOfPeriod));
}

bool ClassAttitude::rests(const scenario::PathPiece& piece) const {
  return waits(piece) && !sways() && !yaw_.turns_between(piece.start, piece.end);
}

bool ClassAttitude::far(const scenario::PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0,
                        time::Nanoseconds t1, const nav::Quaternion& q1) {
  if (t1 - t0 > farthest_) return true;
  for (int i = 1; i <= 3; ++i) {
    const nav::Quaternion here = q_ev(piece, t0 + i * (t1 - t0) / 4);
    if (nav::angle_between(q0.slerp(0.25 * i, q1), here) > kOffArc_rad) return true;
  }
  return false;
}

nav::Quaternion ClassAttitude::q_ev(const scenario::PathPiece& piece, time::Nanoseconds instant) {
  const double t_s = time::to_seconds(instant - piece.start);
  PathInstant here = path_instant(piece, t_s, gravity_);
  if (nose_) here.along_n = nose_->along_n(piece, t_s, here.v_n);
  return nav::quaternion_from_matrix(here.C_en * C_nv(here, instant));
}

bool ClassAttitude::sways() const {
  return attitude_.vehicle_class == scenario::VehicleClass::Ship &&
         (attitude_.roll_amplitude_deg > 0.0 || attitude_.pitch_amplitude_deg > 0.0);
}

nav::Matrix3 ClassAttitude::C_nv(const PathInstant& here, time::Nanoseconds instant) const {
  const double t_s = time::to_seconds(instant);
  const auto wave = [&](double amplitude_deg, double period_s) {
    return units::kDeg * amplitude_deg * std::sin(2.0 * units::kPi * t_s / period_s);
  };
  switch (attitude_.vehicle_class) {
    case scenario::VehicleClass::Multirotor:
      return attitude_of_thrust(here.f_n + attitude_.drag_per_s * here.v_n, yaw_.at(instant));
    case scenario::VehicleClass::FixedWing:
      return attitude_of_lift(here, units::kDeg * attitude_.max_bank_deg,
                              share_of_flight(here.v_n.norm(), attitude_.lift_off_speed_m_per_s),
                              units::kDeg * attitude_.angle_of_attack_deg);
    case scenario::VehicleClass::Ship:
    case scenario::VehicleClass::NoseAlongTrack:
      break;
  }
  return nav::matrix_from_rpy({wave(attitude_.roll_amplitude_deg, attitude_.roll_period_s),
                               wave(attitude_.pitch_amplitude_deg, attitude_.pitch_period_s),
                               std::atan2(here.along_n.y(), here.along_n.x())});
}

}  // namespace inslab::trajectory
