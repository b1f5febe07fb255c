#pragma once

#include <vector>

#include "inslab/nav/attitude.hpp"
#include "inslab/scenario/vehicle_class.hpp"

namespace inslab::trajectory {

/// Velocity and acceleration of a path at one place, in that place's n. The acceleration is relative to the Earth.
struct PathMotion {
  nav::Vector3 v_n = nav::Vector3::Zero();  ///< m/s
  nav::Vector3 a_n = nav::Vector3::Zero();  ///< m/s^2
};

/// Whether it is faster over the ground than a vehicle at standstill.
bool is_moving(const PathMotion& motion, const scenario::VehicleAttitude& options);

/// The bank of a coordinated turn, rad, right side down positive: tan(bank) = v_h yaw'/g, where v_h yaw' is the
/// acceleration across the track; within the limit. 0 at rest. g = 9.80665 m/s^2.
double bank_of_turn_rad(const PathMotion& motion, double max_bank_rad);

/// The attitudes along a path, in the path's order: yaw and pitch of the velocity, bank of the turn. While the
/// horizontal speed is below the limit for standstill, yaw and pitch stay as they were and the bank is 0; before the
/// path moves for the first time they are those of the first motion, and 0 if it never moves.
std::vector<nav::RollPitchYaw> attitudes_along(const std::vector<PathMotion>& motions,
                                               const scenario::VehicleAttitude& options);

}  // namespace inslab::trajectory
