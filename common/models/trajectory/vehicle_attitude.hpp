#pragma once

#include "inslab/nav/gravity.hpp"
#include "inslab/scenario/path_piece.hpp"
#include "inslab/scenario/trajectory.hpp"
#include "inslab/scenario/waypoint_route.hpp"

namespace inslab::trajectory {

/// Where a vehicle on a path is at one instant and what carries it there, in that place's n.
struct PathInstant {
  nav::Geodetic position;
  nav::Matrix3 C_en = nav::Matrix3::Identity();
  nav::Vector3 along_n = nav::Vector3::UnitX();  ///< direction of the line, at rest too; not of length 1
  nav::Vector3 v_n = nav::Vector3::Zero();       ///< m/s
  nav::Vector3 a_n = nav::Vector3::Zero();       ///< m/s^2, relative to the Earth
  nav::Vector3 f_n = nav::Vector3::Zero();       ///< specific force, m/s^2
};

PathInstant path_instant(const scenario::PathPiece& piece, double t_s, const nav::Gravity& gravity);

/// From 0 at 0 to 1 at 1 with no rate and no acceleration at either end: 10 x^3 - 15 x^4 + 6 x^5.
double smooth_step(double x);

/// C_nv whose -z_v points along the thrust and whose Z-Y-X yaw is `yaw_rad`.
nav::Matrix3 attitude_of_thrust(const nav::Vector3& thrust_n, double yaw_rad);

/// C_nv with the nose along the velocity, rolled until the specific force has no side part: at most by `max_bank_rad`.
nav::Matrix3 attitude_of_lift(const PathInstant& instant, double max_bank_rad, double share_of_flight,
                              double angle_of_attack_rad);

/// From 0 on the ground to 1 in the air, over the speeds from lift-off to 1.25 times it.
double share_of_flight(double speed_m_per_s, double lift_off_speed_m_per_s);

/// Yaw of a vehicle whose nose is free, rad: from waypoint to waypoint the shorter way round, with the angle
/// 10 x^3 - 15 x^4 + 6 x^5 over the wait there, or over the leg that leads there when there is none.
class YawSchedule {
 public:
  /// `first_rad` until a waypoint says otherwise.
  YawSchedule(double first_rad, const std::vector<scenario::Waypoint>& waypoints, const scenario::WaypointRoute& route);
  /// Always the same.
  explicit YawSchedule(double yaw_rad) : first_rad_(yaw_rad) {}

  double at(time::Nanoseconds instant) const;
  /// Whether the yaw changes somewhere between two instants.
  bool turns_between(time::Nanoseconds start, time::Nanoseconds end) const;

 private:
  struct Turn {
    time::Nanoseconds start{0};
    time::Nanoseconds end{0};
    double from_rad = 0.0;
    double change_rad = 0.0;
  };

  double first_rad_ = 0.0;
  std::vector<Turn> turns_;
};

}  // namespace inslab::trajectory
